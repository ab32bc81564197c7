// SPDX-License-Identifier: MIT
//
// Scenes on which builders, colliders and libraries have failed, by families, one line each in the catalog. All are
// generated, and the same for the same seed on every machine but for a last bit of sin and cos.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"

namespace bvhbench {

/// How large scenes are to be, and which.
struct StressSize {
    bool quick = false;
    std::uint64_t seed = 1;

    uint triangles() const { return quick ? 300 : 5000; }

    /// Where all pairs overlap.
    uint crowded_triangles() const { return quick ? 120 : 300; }
};

/// Triangles of one or more objects, together all of them in order. Unlike a Scene it may hold what `finished` refuses.
struct StressScene {
    Mesh mesh;
    std::vector<FaceRange> objects;
};

/// A scene to be made: some of them are too large to be kept.
struct StressCase {
    std::string name;  ///< within its family, as "1e6"
    std::function<StressScene()> make;
    bool is_large =
        false;  ///< past 2^24 triangles: only builders, and what is checked of them in parallel
};

struct StressFamily {
    std::string_view name;
    std::string_view summary;
    std::vector<StressCase> (*cases)(const StressSize& size);
};

/// All families, in the order tables list them.
std::span<const StressFamily> stress_families();

/// Of one object.
StressScene single(Mesh mesh);

/// Of two objects, the second behind the first.
StressScene together(const Mesh& first, const Mesh& second);

/// Two spheres of together so many triangles that lie across each other, of about one unit's size. How they lie
/// depends on the seed.
StressScene crossed_spheres(uint triangles, std::uint64_t seed);

/// Every coordinate by `change(double) -> double`, rounded to float once.
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
