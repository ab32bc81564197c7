// SPDX-License-Identifier: MIT
//
// The scripts in plots/, which read result files: run by the system's Python.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bvhbench {

/// Replaces this process by the command `words` of plots/. Returns only by throwing Unavailable.
[[noreturn]] void become_python(const std::vector<std::string>& words);

/// Prints the tables of a result document. Throws Unavailable if Python cannot.
void print_tables(const std::string& document);

/// Draws what `script` of plots/ draws of a result file, into a folder. Returns what became of it, a line.
std::string draw(const std::string& script, const std::filesystem::path& file,
                 const std::filesystem::path& folder, bool force);

}  // namespace bvhbench
