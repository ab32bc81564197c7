// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace bvhbench {

/// The name of an OpenCL error code: "CL_OUT_OF_RESOURCES"; "OpenCL error -9999" for one of a vendor's own.
std::string opencl_error_name(int code);

}  // namespace bvhbench
