// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "device/cl.h"
#include "library/include/bvhbench/oibvh.h"

namespace bvhbench::python {

/// A device with a queue of its own. Trees of one device share its kernels and are called one at a time.
struct OpenDevice {
    std::string name;         ///< "Platform/device"
    bool shares_host_memory;  ///< whether it reads arrays of the host where they are
    cl::CommandQueue queue;
    oibvh::Device device;
};

/// Returns the device that `words` select as docs/python.md says; each device is opened once. Throws oibvh::Error.
std::shared_ptr<OpenDevice> opened(const std::string& words);

}  // namespace bvhbench::python
