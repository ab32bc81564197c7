// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace bvhbench {

/// Have plots/<script> draw `file` into `folder`. Returns one sentence: what was drawn, or why nothing was and
/// how to draw it elsewhere. The plots are found under BVHBENCH_HOME, else where the program was built.
std::string draw(const std::string& script, const std::filesystem::path& file,
                 const std::filesystem::path& folder);

}  // namespace bvhbench
