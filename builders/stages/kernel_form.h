// SPDX-License-Identifier: MIT
#pragma once

#include "builders/parameters.h"
#include "device/device.h"

namespace bvhbench {

/// Two forms of the same kernels, with equal results. Which one is faster depends on the device.
enum class KernelForm {
    of_device,  ///< `chunks` on a CPU, `groups` elsewhere.
    groups,  ///< Work-groups of many lanes, which share local memory and process neighbouring items.
    chunks,  ///< A few work-items, each of which processes a long run of neighbouring items.
};

/// Returns `form`, or the device's own form if it is of_device.
inline KernelForm chosen_form(const Device& device, KernelForm form)
{
    if (form != KernelForm::of_device)
        return form;
    return device.is_cpu() ? KernelForm::chunks : KernelForm::groups;
}

/// As above, but returns `chunks` for of_device if the device lacks this much local memory or groups of this size.
inline KernelForm chosen_form(const Device& device, KernelForm form, std::size_t local_bytes,
                              std::size_t group_size)
{
    const bool fits = device.cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>() >= local_bytes &&
                      device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>() >= group_size;
    return form == KernelForm::of_device && !fits ? KernelForm::chunks : chosen_form(device, form);
}

/// Returns the work-items for the form `chunks`: several per core, so that an interrupted core delays the others little.
inline std::size_t chunk_count(const Device& device)
{
    return device.tuned(chunks_per_core) *
           std::size_t{device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()};
}

}  // namespace bvhbench
