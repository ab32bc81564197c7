// SPDX-License-Identifier: MIT
//
// What processes have in common that this program starts from itself: readers of files, libraries under stress, cells of a
// sweep.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bvhbench {

/// "NAME=value" for the environment of a process that is not to outlive this one, whatever ends it.
std::string ends_with_this_process();

/// At the beginning of main: from here on end with the process that started this one, if that wants it so.
void end_with_parent();

/// What a worker begins with: it ends with its parent, leaves no core file, and takes no more than so much memory, nor than
/// its parent may. Throws Unavailable if it has more already.
void limit_worker(std::size_t memory_bytes);

/// Keeps standard output for the worker's answer alone: whatever is written there, or to standard error, is thrown away from
/// now on. Returns the file for the answer.
int take_standard_output();

/// All of it, whether signals come or not. False if it could not be written.
bool write_all(int file, std::string_view bytes);

}  // namespace bvhbench
