// SPDX-License-Identifier: MIT
//
// Scenes on which builders, colliders and libraries have failed, in families with one line each in the catalog. All are
// generated and are the same for a seed on every machine, up to the last bit of sin and cos.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"

namespace bvhbench {

/// Size of the scenes, and the seed that they are generated from.
struct StressSize {
    bool quick = false;
    std::uint64_t seed = 1;

    uint triangles() const { return quick ? 300 : 5000; }

    /// Number of triangles in scenes in which all pairs overlap.
    uint crowded_triangles() const { return quick ? 120 : 300; }
};

/// Triangles of one or more objects, which cover all triangles in order. Unlike a Scene, it may hold what `finished` refuses.
struct StressScene {
    Mesh mesh;
    std::vector<FaceRange> objects;
};

/// A scene to be generated when needed, because some scenes are too large to be kept.
struct StressCase {
    std::string name;  ///< name within its family, such as "1e6"
    std::function<StressScene()> make;
    bool is_large =
        false;  ///< more than 2^24 triangles: only builders are tested, with checks that run in parallel
};

struct StressFamily {
    std::string_view name;
    std::string_view summary;
    std::vector<StressCase> (*cases)(const StressSize& size);
};

/// Returns all families, in the order of tables.
std::span<const StressFamily> stress_families();

/// Returns a scene of one object.
StressScene single(Mesh mesh);

/// Returns a scene of two objects, the second stored after the first.
StressScene together(const Mesh& first, const Mesh& second);

/// Returns two intersecting spheres of about unit size, `triangles` triangles in total. The seed determines their placement.
StressScene crossed_spheres(uint triangles, std::uint64_t seed);

/// Returns `scene` with every coordinate replaced by `change(double) -> double`, rounded to float once.
template <class Change>
StressScene changed(StressScene scene, const Change& change)
{
    for (Point& p : scene.mesh.points)
        for (float Point::*c : {&Point::x, &Point::y, &Point::z})
            p.*c = static_cast<float>(change(static_cast<double>(p.*c)));
    return scene;
}

std::vector<StressCase> degenerate_cases(const StressSize& size);
std::vector<StressCase> needle_cases(const StressSize& size);
std::vector<StressCase> coplanar_cases(const StressSize& size);
std::vector<StressCase> coincident_cases(const StressSize& size);
std::vector<StressCase> far_triangle_cases(const StressSize& size);

}  // namespace bvhbench
