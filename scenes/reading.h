// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bvhbench {

/// What reading a file did besides taking its triangles over as they are.
struct Reading {
    std::uint64_t polygons_cut = 0;      ///< faces of more than three corners
    std::uint64_t polygons_concave = 0;  ///< of these, those that a fan does not cover: cut by ears
    std::uint64_t polygons_crossing = 0;  ///< of these, those that cross themselves
    std::uint64_t joined_vertices = 0;    ///< vertices that became one with another
    std::vector<std::string> surprises;   ///< one line each, told to the user
    std::vector<std::string> ignored;     ///< what else the file has, such as "3 materials"
};

/// Facts about the triangles of a scene's first frame, as they were read and rounded.
struct MeshFacts {
    std::uint64_t unused_vertices = 0;  ///< named by no triangle
    /// Vertices that have the position of another one in all frames, so that `--weld` joins the two.
    std::uint64_t weldable_vertices = 0;
    std::uint64_t shared_edges = 0;       ///< of two triangles
    std::uint64_t open_edges = 0;         ///< of one triangle
    std::uint64_t nonmanifold_edges = 0;  ///< of more than two
    std::uint64_t without_area = 0;       ///< triangles whose corners are on a line, exactly
    std::uint64_t duplicate = 0;          ///< triangles that name the corners of another one
    std::uint64_t equal = 0;  ///< other triangles whose corners have the positions of another one's
    std::array<float, 3> low = {}, high = {};  ///< corners of the box of all triangles
    double longest_edge = 0, median_edge = 0;
    double float_step = 0;      ///< distance between floats at the largest coordinate
    double expected_pairs = 0;  ///< estimate of the pairs of boxes without common vertices
};

}  // namespace bvhbench
