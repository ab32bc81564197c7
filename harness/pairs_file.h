// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "collide/pairs.h"
#include "harness/output.h"

namespace bvhbench {

/// Throws BadUsage unless `path` ends in .csv or .bin.
void check_pairs_path(const std::filesystem::path& path);

/// Write the list to `output`, which is named so, in its canonical order: .csv has the line a,b and then a line a pair; .bin little-endian 32-bit
/// ids, two a pair and nothing else, whose FNV-1a is the list's hash. Throws as Output does.
void write_pairs(const Output& output, const PairList& pairs);

}  // namespace bvhbench
