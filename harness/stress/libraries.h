// SPDX-License-Identifier: MIT
//
// Libraries that may crash, hang or take all memory are called in a process of their own: this program, started again
// with a hidden first argument. Every main that may judge one begins with
//
//     if (is_library_worker(argc, argv))
//         return library_worker_main(argc, argv);
#pragma once

#include "baselines/plain_libraries.h"
#include "harness/stress/judge.h"

namespace bvhbench {

bool is_library_worker(int argc, char** argv);
int library_worker_main(int argc, char** argv);

/// A library, in another process, held to what is to be found among the triangles that have places, whatever it says of the
/// others. It is a finding if it crashes, says that it cannot, or has not answered after `time_limit_s`.
Findings judge_library(const PlainLibrary& library, const StressScene& scene, double time_limit_s);

/// The triangles of a scene whose vertices are finite, as a scene of its own, and which they are in the other one.
StressVariant finite_part(const StressScene& scene);

}  // namespace bvhbench
