// SPDX-License-Identifier: MIT
//
// Runs the Python scripts in plots/, which read result files, with the system's Python.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/base/common_options.h"

namespace bvhbench {

/// Replaces this process by the plots/ command `words`. Throws Unavailable on failure and otherwise does not return.
[[noreturn]] void become_python(const std::vector<std::string>& words);

/// Prints the tables of a result document, unless --quiet is given. Throws Unavailable if Python cannot be run or fails.
void print_tables(const std::string& document, const CommonOptions& common);

/// Draws the result file into `folder` by `plot`, which says what it drew. Returns one line that says why nothing was drawn; empty if
/// it was.
std::string draw(const std::filesystem::path& file, const std::filesystem::path& folder,
                 bool force);

}  // namespace bvhbench
