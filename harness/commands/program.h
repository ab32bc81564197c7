// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace bvhbench {

/// Parses `argv`, runs the command and returns the exit code: 0 success, 1 a check differs, 2 wrong usage, 3 no device, file,
/// library or memory, 4 nothing was measured. Prints errors as one sentence on standard error. May be called repeatedly; a
/// command in Python replaces the process.
int run_program(int argc, const char* const* argv);

/// Runs `work` and returns its exit code. Prints an exception as one sentence on standard error and returns the exit code for it.
int exit_code_of(const std::function<int()>& work);

/// Parses `argv` without running anything. Throws BadUsage with one sentence if it is invalid.
void check_words(int argc, const char* const* argv);

}  // namespace bvhbench
