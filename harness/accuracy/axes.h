// SPDX-License-Identifier: MIT
//
// What each axis's file gives to the list in axes.cpp: as harness/accuracy/axis.h says of `measure` and `report`.
#pragma once

#include <string>

#include "harness/record.h"

namespace bvhbench {

struct AxisRun;

void measure_narrow(const AxisRun& run);
std::string report_narrow(const Document& document);

void measure_sums(const AxisRun& run);
std::string report_sums(const Document& document);

void measure_codes(const AxisRun& run);
std::string report_codes(const Document& document);

void measure_input(const AxisRun& run);
std::string report_input(const Document& document);

void measure_boxes(const AxisRun& run);
std::string report_boxes(const Document& document);
void measure_swept(const AxisRun& run);
std::string report_swept(const Document& document);

}  // namespace bvhbench
