// SPDX-License-Identifier: MIT
//
// The only file that includes the Khronos C++ bindings, so that their configuration is the same everywhere.
#pragma once

#include <string>

#define CL_HPP_ENABLE_EXCEPTIONS
// Both versions are 1.2, so that the bindings (2023.02) never query a device's platform version. With an older minimum they
// query it at every copy of a cl::Device and, if the query fails, read an uninitialized variable; tests/faults makes it fail.
// Newer features are used through the C interface.
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

/// Returns the name of an OpenCL error code, such as "CL_OUT_OF_RESOURCES", or "OpenCL error -9999" for an unknown code.
std::string opencl_error_name(int code);

}  // namespace bvhbench
