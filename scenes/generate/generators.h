// SPDX-License-Identifier: MIT
//
// Generators of meshes and moving scenes with exactly N triangles. All are deterministic: the same N gives the same scene. The
// torus and the sphere use sin and cos and may differ in the last bit between C libraries; the others use only +, -, *, / and
// square root, which IEEE 754 defines.
#pragma once

#include <span>
#include <string_view>

#include "geometry/mesh.h"
#include "scenes/scene.h"

namespace bvhbench {

/// Functions called ..._run make some triangles of the mesh of `triangles` triangles that the function make_... makes, without
/// making the others.
MeshRun torus_run(uint triangles, FaceRange run);
MeshRun grid_run(uint triangles, FaceRange run);
MeshRun hairball_run(uint triangles, FaceRange run);
MeshRun soup_run(uint triangles, FaceRange run);

/// Triangles whose boxes have side 2 and lie evenly in a cube, or around its surface.
MeshRun filled_cube_run(uint triangles, FaceRange run);
MeshRun hollow_cube_run(uint triangles, FaceRange run);

/// A bumpy torus, an evenly tessellated closed surface: the usual stand-in for a scanned model. Vertices at the two seams are
/// not shared.
Mesh make_torus(uint triangles);

/// A sphere of rings of nearly equal triangles; closed if `triangles` is even and at least 6.
Mesh make_sphere(uint triangles);

/// A flat sheet in z = 0: boxes without volume that touch exactly.
Mesh make_grid(uint triangles);

/// A ball of long thin curling strands: many more boxes overlap than triangles do.
Mesh make_hairball(uint triangles);

/// Small random triangles in the unit cube without shared vertices. `triangles` <= 2^32 / 3.
Mesh make_soup(uint triangles);

/// A sheet of exactly `triangles` triangles over the unit square, with points at (u, v, 0): about `aspect` times as many quads
/// along u as along v, two triangles each, row by row; the last row may be incomplete. `closed`: the points at u = 1 are those
/// at u = 0. Every point is a corner of some triangle.
Mesh make_sheet(uint triangles, double aspect, bool closed);

/// Appends `part` to `mesh`.
void append(Mesh& mesh, const Mesh& part);

// Moving scenes: simulations of moving objects. Cloth is simulated with as many particles as N requires, up to about ten
// thousand; finer meshes are sampled from the smooth surface through the particles. The motion is therefore nearly the same for
// every N, and its cost is bounded.

/// A square cloth falls on a ball that stands on a floor and begins to turn. Objects: cloth, ball.
Scene make_cloth_ball(uint triangles, uint frames);

/// Nine skirts, three layers at each of three heights, around a turning dancer. Objects: body, nine skirts.
Scene make_cloth_dress(uint triangles, uint frames);

/// A ball pushes a square cloth through a funnel. Objects: cloth, funnel, ball, floor.
Scene make_cloth_funnel(uint triangles, uint frames);

/// Three square cloths, stacked vertically, fall on a turning ball. Objects: three cloths, ball.
Scene make_cloth_layers(uint triangles, uint frames);

/// 305 balls fall to their common centre, bounce, and stay there in a heap. Each of them rotates.
Scene make_n_body(uint triangles, uint frames);
constexpr uint n_body_count = 305;

/// Two spheres rotate while one sinks into the other, until a twentieth of each surface is inside the other.
Scene make_two_spheres(uint triangles, uint frames);

/// Worlds as robots learn in: `worlds` objects of `bodies` boxes each, a degenerate triangle over each box (the lowest corner, and twice
/// the highest). Lengths are metres, y is up. Body 0 of a world is a floor that reaches below all others, a third of the rest, up to 28,
/// are links of a robot, and the others lie on the floor in piles of one to three. Robots and a tenth of the piles move, the rest
/// stands still. Worlds differ, and stand apart in a square, so that methods that know of no worlds find the same pairs.
/// `worlds` * `bodies` <= 2^28.
Scene make_worlds(uint worlds, uint bodies, uint frames);

/// `bodies` balls of `each` triangles and radius 1 in a cubic lattice, an object each. Each reaches into its six neighbours. From frame to
/// frame every tenth slides on, and the others rest. `bodies` * `each` <= 2^28.
Scene make_bodies(uint bodies, uint each, uint frames);

/// A generator by name: "torus:N", or "cloth-ball:N:F" for moving scenes.
struct Generator {
    static constexpr uint usual_frames = 16, most_frames = 1000;

    std::string_view name;
    Scene (*make)(uint triangles, uint frames);
    bool moves;
    uint least;  ///< minimum number of triangles: one per object
    uint most;   ///< maximum number of triangles, such that vertex indices fit in 32 bits
    uint bytes_a_triangle;  ///< approximate memory per triangle, and
    uint bytes_a_frame;     ///< memory per triangle and frame
    std::string_view summary;
    /// Makes some triangles of a mesh; null if only the whole can be made.
    MeshRun (*run)(uint triangles, FaceRange run) = nullptr;
};

/// A generator of `objects` objects with `each` triangles each, by name: "worlds:W:B", or "worlds:W:B:F" for F frames.
struct CrowdGenerator {
    static constexpr uint most_triangles = 0x10000000u;

    std::string_view name;
    Scene (*make)(uint objects, uint each, uint frames);
    std::string_view letters;  ///< of the two counts, as in "W:B"
    uint bytes_a_triangle;     ///< approximate memory per triangle, and
    uint bytes_a_frame;        ///< memory per triangle and frame
    std::string_view summary;
};

/// Returns all generators of crowds.
std::span<const CrowdGenerator> crowd_generators();

/// Returns the generator of crowds with this name; nullptr if there is none.
const CrowdGenerator* crowd_generator_called(std::string_view name);

/// Returns all generators, those of one frame first.
std::span<const Generator> generators();

/// Returns the generator with this name; nullptr if there is none.
const Generator* generator_called(std::string_view name);

}  // namespace bvhbench
