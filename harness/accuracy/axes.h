// SPDX-License-Identifier: MIT
//
// What each axis's file gives to the list in axes.cpp: as harness/accuracy/axis.h says of `measure`.
#pragma once

namespace bvhbench {

struct AxisRun;

void measure_narrow(const AxisRun& run);
void measure_sums(const AxisRun& run);
void measure_codes(const AxisRun& run);
void measure_input(const AxisRun& run);
void measure_boxes(const AxisRun& run);
void measure_swept(const AxisRun& run);

}  // namespace bvhbench
