// SPDX-License-Identifier: MIT
//
// Checks and converts the triangles that ranks pass.
#pragma once

#include <vector>

#include "cluster/share.h"
#include "library_cluster/include/bvhbench/oibvh_cluster.h"

namespace bvhbench::oibvh {

std::vector<bvhbench::Point> own_points(std::span<const Point> points);
std::vector<bvhbench::Face> own_faces(std::span<const Face> faces);

/// Returns the triangles that a rank passes, as a share.
Share share_of(const RankTriangles& given);

/// Throws BadUsage unless there are as many numbers as faces and points.
void require_numbers(const RankTriangles& given);

/// Throws BadUsage unless the ranks together have 1 to 2^31 triangles, of which this one has `own`. All ranks must call.
void require_count(std::size_t own, Ranks& ranks);

/// Throws BadUsage about the first index out of range.
void require_corners(std::span<const Face> faces, std::size_t points);

/// Throws BadUsage about the first point that is not finite.
void require_finite(std::span<const Point> points);

/// Throws BadUsage, the same on all ranks, if two triangles have one number. All ranks must call.
void require_unique(std::span<const std::uint32_t> triangles, Ranks& ranks);

/// Throws BadUsage, the same on all ranks, unless all pass the same value. All ranks must call.
void require_same(const char* what, double value, Ranks& ranks);

}  // namespace bvhbench::oibvh
