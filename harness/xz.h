// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace bvhbench {

/// Whether a file with these contents is a .xz file.
bool is_xz(std::string_view file);

/// The contents of a .xz file, unpacked; `what` names it in errors. Throws Unavailable if it is damaged or cut off, or if the
/// host has not the memory for what comes out.
std::string unpacked_xz(std::string_view file, const std::string& what);

}  // namespace bvhbench
