// SPDX-License-Identifier: MIT
#pragma once

namespace bvhbench {

/// Parses `argv`, runs the command and returns the exit code: 0 success, 1 a check differs, 2 wrong usage, 3 no device, file,
/// library or memory, 4 nothing was measured. Prints errors as one sentence on standard error. May be called repeatedly; a
/// command in Python replaces the process.
int run_program(int argc, const char* const* argv);

/// Parses `argv` without running anything. Throws BadUsage with one sentence if it is invalid.
void check_words(int argc, const char* const* argv);

}  // namespace bvhbench
