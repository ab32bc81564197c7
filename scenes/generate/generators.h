// SPDX-License-Identifier: MIT
//
// Meshes and moving scenes of exactly N triangles. All are deterministic: the same N gives the same scene. What uses sin and
// cos (torus, sphere) may differ in a last bit between C libraries; the others use only +, -, *, / and
// square root, which IEEE 754 fixes.
#pragma once

#include <span>
#include <string_view>

#include "geometry/mesh.h"
#include "scenes/scene.h"

namespace bvhbench {

/// A bumpy torus, an evenly tessellated closed surface: the usual stand-in for a scanned model.
/// Vertices at the two seams are not shared.
Mesh make_torus(uint triangles);

/// A sphere of rings of nearly equal triangles; closed when `triangles` is even and at least 6.
Mesh make_sphere(uint triangles);

/// A flat sheet in z = 0: boxes without volume that touch exactly.
Mesh make_grid(uint triangles);

/// A ball of long thin curling strands: boxes overlap far more than triangles do.
Mesh make_hairball(uint triangles);

/// Small random triangles in the unit cube that share no vertices. `triangles` <= 2^32 / 3.
Mesh make_soup(uint triangles);

/// A sheet of exactly `triangles` over the unit square, its points at (u, v, 0): about `aspect` times as many
/// quads along u as along v, cut in two each, row by row; the last row may stop before its end. `closed`: what
/// is at u = 1 is at u = 0. Every point is a corner of some triangle.
Mesh make_sheet(uint triangles, double aspect, bool closed);

/// Puts `part` behind what `mesh` holds.
void append(Mesh& mesh, const Mesh& part);

// Scenes over time: objects that move, simulated. What cloth does is simulated with as many particles as N asks for, up to
// some ten thousand; finer meshes are points of the smooth surface through these. So the motion is nearly the same whatever
// N is, and its cost is bounded.

/// A square cloth falls on a ball that begins to turn, on a floor. Objects: cloth, ball.
Scene make_cloth_ball(uint triangles, uint frames);

/// Nine skirts, three layers at each of three heights, round a dancer who turns. Objects: body, nine skirts.
Scene make_cloth_dress(uint triangles, uint frames);

/// A ball pushes a square cloth through a funnel. Objects: cloth, funnel, ball, floor.
Scene make_cloth_funnel(uint triangles, uint frames);

/// Three square cloths, one above the other, fall on a ball that turns. Objects: three cloths, ball.
Scene make_cloth_layers(uint triangles, uint frames);

/// 305 balls fall to their common centre, bounce, and stay there in a heap, each turning as it goes.
Scene make_n_body(uint triangles, uint frames);
constexpr uint n_body_count = 305;

/// Two spheres turn while one sinks into the other, until a twentieth of each surface is inside.
Scene make_two_spheres(uint triangles, uint frames);

/// A generator by name, as "torus:N", or "cloth-ball:N:F" of those that move.
struct Generator {
    static constexpr uint usual_frames = 16, most_frames = 1000;

    std::string_view name;
    Scene (*make)(uint triangles, uint frames);
    bool moves;
    uint least;             ///< triangles: one for each object
    uint most;              ///< triangles, so that vertex indices fit 32 bits
    uint bytes_a_triangle;  ///< of memory, about, and
    uint bytes_a_frame;     ///< a triangle
    std::string_view summary;
};

/// All generators: those of one frame first.
std::span<const Generator> generators();

/// nullptr if no generator is called so.
const Generator* generator_called(std::string_view name);

}  // namespace bvhbench
