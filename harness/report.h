// SPDX-License-Identifier: MIT
//
// Results for the console. A time is printed only for a cell whose tree was right.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "harness/record.h"
#include "harness/statistics.h"

namespace bvhbench {

/// The builder's name, with the options that are not the default.
std::string variant_text(const BuilderChoice& builder);

/// The same of a collider.
std::string variant_text(const ColliderChoice& collider);

/// What was measured: a builder, or a collider over its trees, and what of it if that is no build.
std::string pipeline_text(const Cell& cell);

/// "hierarchy" or all stages together of each sample, in nanoseconds.
std::vector<double> stage_times_ns(const Cell& cell, std::string_view stage);
std::vector<double> whole_times_ns(const Cell& cell);

/// Bytes that a build's kernels must move at least; 0 for host stages.
double moved_bytes(const Cell& cell);

/// "8.1 %" of the copy rate that `bytes` in `ns` are; blank if one of them is not known.
std::string copy_share_text(double bytes, double ns, double copy_rate_bytes_per_s);

/// Whether its stages have times that may be printed: measured, and not wrong.
bool has_times(const Cell& cell);

/// "agrees", "differs", "counted", "not checked", "skipped" or "failed".
std::string verdict_text(const Cell& cell);

/// One cell in full: its stages as a table, its counters and its verdict.
std::string cell_report(const Cell& cell, const RunFacts& run);

/// Which cells that agree get a line. All others do.
enum class Lines { all, of_builds, notable };

/// The cells of a run, a line each of those that `lines` says; all are counted.
std::string cells_report(const Document& document, Lines lines = Lines::all);

/// Every frame of a collision run in a line.
std::string frames_report(const Document& document);

/// Where the leaves are: "14–38, half by 19"; "17" if all are on one level.
std::string depths_text(const std::vector<std::int64_t>& leaves_by_depth);

/// "an inner node 1.2, a triangle 1"
std::string costs_text(const NodeCosts& costs);

/// Where and with what a run was made, in a few lines.
std::string run_report(const RunFacts& run);

/// Of a merged file: how many runs its cells are from, on which hosts and devices, by which commits. Else empty.
std::string merged_report(const Document& document);

}  // namespace bvhbench
