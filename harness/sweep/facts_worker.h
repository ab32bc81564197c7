// SPDX-License-Identifier: MIT
//
// A sweep opens no device itself: some let one process in at a time, and a driver that crashes would take the sweep along.
// What it must know of one it asks a process of its own: this program, started again with a hidden first argument. Every
// main that may sweep begins with
//
//     if (is_facts_worker(argc, argv))
//         return facts_worker_main(argc, argv);
#pragma once

#include <string>
#include <vector>

#include "harness/options.h"
#include "harness/record.h"

namespace bvhbench {

bool is_facts_worker(int argc, char** argv);
int facts_worker_main(int argc, char** argv);

/// The options that all commands have, as they are written on a command line, with this device.
std::vector<std::string> common_words(const CommonOptions& common, const std::string& device);

/// The circumstances of a run on the device, its copy rate measured. Throws Unavailable, with the sentence of the process
/// that tried.
RunFacts facts_of_device(const CommonOptions& common, const std::string& device);

}  // namespace bvhbench
