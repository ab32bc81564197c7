// SPDX-License-Identifier: MIT
//
// What Scalable-CCD's own build would write: with CUDA, in floats, without its profiler.
#pragma once

#define SCALABLE_CCD_WITH_CUDA
