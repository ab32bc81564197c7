// SPDX-License-Identifier: MIT
//
// Scenes over time, of exactly N triangles in all: objects that move, simulated. What cloth does is simulated
// with as many particles as N asks for, up to some ten thousand; finer meshes are points of the smooth surface
// through these. So the motion is nearly the same whatever N is, and its cost is bounded.
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

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

}  // namespace bvhbench
