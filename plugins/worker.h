// SPDX-License-Identifier: MIT
//
// The process of a plug-in: this program, started again. It becomes the program of --program, or loads the library of --plugin
// and speaks the protocol for it.
#pragma once

#include <string>
#include <vector>

#include "plugins/protocol.h"

namespace bvhbench::outside {

/// Returns the words that start this program as the library's process.
std::vector<std::string> worker_words(const Library& library);

/// True if this process was started with worker_words().
bool is_worker(int argc, char** argv);

/// Runs the worker and returns its exit code.
int worker_main(int argc, char** argv);

}  // namespace bvhbench::outside
