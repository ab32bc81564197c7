// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace bvhbench {

/// All of a file, unpacked if it is packed by xz. Throws Unavailable, "WHAT 'path' cannot be read: REASON", if it cannot be
/// read, is damaged, or the host has not the memory for it and what is made of it.
std::string file_text(const std::filesystem::path& path, const std::string& what);

}  // namespace bvhbench
