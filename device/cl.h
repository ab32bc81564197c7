// SPDX-License-Identifier: MIT
//
// The only place that includes the Khronos bindings, so that every file sees them configured alike.
#pragma once

#include <string>

#define CL_HPP_ENABLE_EXCEPTIONS
// Both 1.2, so that the bindings of 2023.02 never ask a device for its platform's version, as they do at every copy of a
// device when the least version is older: where that question fails they read what was never written.
// tests/faults makes it fail. What is newer is asked of the C interface.
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 300

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <CL/opencl.hpp>
#pragma GCC diagnostic pop

namespace bvhbench {

/// The name of an OpenCL error code: "CL_OUT_OF_RESOURCES"; "OpenCL error -9999" for one of a vendor's own.
std::string opencl_error_name(int code);

}  // namespace bvhbench
