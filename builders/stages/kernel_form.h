// SPDX-License-Identifier: MIT
#pragma once

#include "builders/parameters.h"
#include "device/device.h"

namespace bvhbench {

/// Kernels come in two forms with equal results. Which one is fast depends on the device.
enum class KernelForm {
    of_device,  ///< chunks on a CPU, groups elsewhere
    groups,     ///< work-groups of many lanes that share local memory and take neighbouring items
    chunks,     ///< a few work-items, each with a long run of neighbouring items to itself
};

/// `form`, or the device's own if that was left open.
inline KernelForm chosen_form(const Device& device, KernelForm form)
{
    if (form != KernelForm::of_device)
        return form;
    return device.is_cpu() ? KernelForm::chunks : KernelForm::groups;
}

/// The same for kernels whose groups want as much memory and as many work-items as GPUs have for long had.
inline KernelForm chosen_form(const Device& device, KernelForm form, std::size_t local_bytes,
                              std::size_t group_size)
{
    const bool fits = device.cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>() >= local_bytes &&
                      device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>() >= group_size;
    return form == KernelForm::of_device && !fits ? KernelForm::chunks : chosen_form(device, form);
}

/// Work-items for the form `chunks`: some a core, so that a core that was interrupted is not waited for.
inline std::size_t chunk_count(const Device& device)
{
    return device.tuned(chunks_per_core) *
           std::size_t{device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()};
}

}  // namespace bvhbench
