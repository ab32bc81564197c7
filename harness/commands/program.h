// SPDX-License-Identifier: MIT
#pragma once

namespace bvhbench {

/// Parses `argv`, runs the command and returns the exit code. An error is one sentence on standard error. 0 done, 1 a check
/// differs, 2 wrong usage, 3 no device, file, library or memory, 4 nothing was measured. May be called again and again;
/// a command that is written in Python takes the place of the process.
int run_program(int argc, const char* const* argv);

/// Parses `argv` and runs nothing. Throws BadUsage, in one sentence, for anything that is not understood.
void check_words(int argc, const char* const* argv);

}  // namespace bvhbench
