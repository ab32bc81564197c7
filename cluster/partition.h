// SPDX-License-Identifier: MIT
//
// Which rank owns which triangle. Every rank passes the triangles that it has now and gets the part that each belongs to; the
// parts do not depend on which rank had a triangle before.
//
//     rcb      recursive coordinate bisection [Berger1987]: halves along the longest side of the box of the centres, at the
//              weighted median; parts are boxes, so few triangles meet another part
//     curve    ranges of a Hilbert curve over all centres; cuts are at multiples of a block of triangles, so a part is whole
//              blocks of the curve whatever the number of parts
//
// Both find their cuts exactly, by a radix selection over all ranks: eight bits of the key a round, one sum of histograms each.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "cluster/ranks.h"
#include "geometry/triangle.h"

namespace bvhbench {

enum class PartitionBy { rcb, curve };

inline constexpr std::string_view partition_names[] = {"rcb", "curve"};

/// The triangles that a rank has before they are distributed.
struct PlacedTriangles {
    std::span<const Point> centres;  ///< of the boxes; finite, without negative zeros
    std::span<const uint> ids;       ///< unique over all ranks; they order equal keys
    /// Work that each triangle stands for, at least 1 each; rcb balances their sums. Empty: 1 each. Not for curve.
    std::span<const uint> weights = {};
};

/// Returns the part, from 0 to `parts` - 1, of each triangle of this rank. With weights of 1, sizes of rcb's parts differ by at
/// most 1; a curve's parts are multiples of curve_block, but for the last.
std::vector<uint> partitioned(const PlacedTriangles& placed, PartitionBy by, uint parts,
                              Ranks& ranks);

/// Triangles of a block that `curve` does not cut: a power of two, at most a 32nd of a mean part, or 1.
std::uint64_t curve_block(std::uint64_t triangles, uint parts);

/// Returns the place on the curve, in triangles, where part `part` begins.
std::uint64_t curve_cut(std::uint64_t triangles, uint part, uint parts);

}  // namespace bvhbench
