// SPDX-License-Identifier: MIT
#include "scenes/generate/catalog.h"

#include "scenes/generate/generators.h"
#include "scenes/generate/moving.h"

namespace bvhbench {
namespace {

constexpr uint any = 0x80000000u;
constexpr uint unshared = 0xffffffffu / 3;

// To add a generator, add its line here. Nothing registers itself.
constexpr Generator catalog[] = {
    {"torus", make_torus, any, 18, "a bumpy torus: an even closed surface, like a scanned model"},
    {"sphere", make_sphere, any, 18, "a sphere, closed when N is even and at least 6"},
    {"grid", make_grid, any, 18, "a flat sheet: boxes without volume that touch exactly"},
    {"hairball", make_hairball, any, 19,
     "long thin curling strands: boxes overlap, triangles do not"},
    {"soup", make_soup, unshared, 48,
     "small random triangles in the unit cube, no shared vertices"},
};

constexpr MovingGenerator moving_catalog[] = {
    {"cloth-ball", make_cloth_ball, 2, "a cloth falls on a ball that turns; 2 objects"},
    {"cloth-layers", make_cloth_layers, 4, "three cloths fall on a ball that turns; 4 objects"},
    {"cloth-funnel", make_cloth_funnel, 4, "a ball pushes a cloth through a funnel; 4 objects"},
    {"cloth-dress", make_cloth_dress, 10, "nine skirts in layers round a dancer; 10 objects"},
    {"n-body", make_n_body, n_body_count,
     "balls fall to their centre and bounce; 305 rigid objects"},
    {"two-spheres", make_two_spheres, 2,
     "one sphere sinks into another, both turn; 2 rigid objects"},
};

}  // namespace

std::span<const Generator> generators() { return catalog; }
std::span<const MovingGenerator> moving_generators() { return moving_catalog; }

}  // namespace bvhbench
