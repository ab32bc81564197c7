// SPDX-License-Identifier: MIT
#include "scenes/generate/catalog.h"

#include "scenes/generate/generators.h"

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

}  // namespace

std::span<const Generator> generators() { return catalog; }

}  // namespace bvhbench
