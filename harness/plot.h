// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bvhbench {

/// The exit status of plots/<script> with these words, run to its end, what it prints passed through; that of plots under
/// BVHBENCH_HOME, else where the program was built. Throws Unavailable if it is not there or cannot be run.
int run_plots_script(const std::string& script, std::vector<std::string> words);

/// Have plots/<script> draw `file` into `folder`. Returns one sentence: what was drawn, or why nothing was and
/// how to draw it elsewhere. The plots are found under BVHBENCH_HOME, else where the program was built. `force` replaces files
/// that are no pictures.
std::string draw(const std::string& script, const std::filesystem::path& file,
                 const std::filesystem::path& folder, bool force = false);

/// Have plots/all.py draw everything that files have the cells for into `folder`; it prints the pictures' names. `force` as above.
/// Throws Unavailable with one sentence: which made no figure, and why; and BadUsage if a file would be replaced that is no picture.
void draw_all(const std::vector<std::string>& files, const std::filesystem::path& folder,
              bool force = false);

}  // namespace bvhbench
