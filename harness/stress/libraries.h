// SPDX-License-Identifier: MIT
//
// Runs libraries that may crash, hang or use up all memory in a separate process: this program, started again with a hidden
// first argument. Every main() that may judge a library begins with
//
//     if (is_library_worker(argc, argv))
//         return library_worker_main(argc, argv);
#pragma once

#include "baselines/plain_libraries.h"
#include "harness/stress/judge.h"

namespace bvhbench {

bool is_library_worker(int argc, char** argv);
int library_worker_main(int argc, char** argv);

/// Runs a library in another process and compares its answer for the triangles with finite vertices; its answer for the others
/// is ignored. A crash, a refusal, or no answer after `time_limit_s` seconds is a finding.
Findings judge_library(const PlainLibrary& library, const StressScene& scene, double time_limit_s);

}  // namespace bvhbench
