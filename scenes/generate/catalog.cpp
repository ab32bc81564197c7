// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenes/generate/generators.h"

namespace bvhbench {
namespace {

template <MeshRun (*run)(uint triangles, FaceRange run)>
Mesh whole(uint triangles)
{
    MeshRun made = run(triangles, {0, triangles});
    return {std::move(made.points), std::move(made.faces)};
}

/// Returns a scene of one frame.
template <Mesh (*make)(uint triangles)>
Scene still(uint triangles, uint)
{
    Mesh mesh = make(triangles);
    Scene scene;
    scene.faces = std::move(mesh.faces);
    scene.frames.push_back(std::move(mesh.points));
    scene.source = "generated";
    return scene;
}

constexpr Generator standing(std::string_view name, Scene (*make)(uint, uint), uint most,
                             uint bytes_a_triangle, std::string_view summary,
                             MeshRun (*run)(uint, FaceRange) = nullptr)
{
    return {name, make, false, 1, most, bytes_a_triangle, 0, summary, run};
}

constexpr Generator moving(std::string_view name, Scene (*make)(uint, uint), uint objects,
                           std::string_view summary)
{
    return {name, make, true, objects, 0x10000000u, 48, 7, summary};
}

constexpr uint any = 0x80000000u;
constexpr uint unshared = 0xffffffffu / 3;

// To add a generator, add its line here. There is no automatic registration.
constexpr Generator catalog[] = {
    standing("torus", still<make_torus>, any, 18,
             "a bumpy torus: an even closed surface, like a scanned model", torus_run),
    standing("sphere", still<make_sphere>, any, 18,
             "a sphere, closed when N is even and at least 6"),
    standing("grid", still<make_grid>, any, 18,
             "a flat sheet: boxes without volume that touch exactly", grid_run),
    standing("hairball", still<make_hairball>, any, 19,
             "long thin curling strands: boxes overlap, triangles do not", hairball_run),
    standing("soup", still<make_soup>, unshared, 48,
             "small random triangles in the unit cube, no shared vertices", soup_run),
    standing("filled-cube", still<whole<filled_cube_run>>, unshared, 48,
             "boxes of side 2 spread evenly in a cube, as in ArborX's benchmark", filled_cube_run),
    standing("hollow-cube", still<whole<hollow_cube_run>>, unshared, 48,
             "boxes of side 2 spread evenly on the surface of a cube, as there", hollow_cube_run),
    moving("cloth-ball", make_cloth_ball, 2, "a cloth falls on a ball that turns; 2 objects"),
    moving("cloth-layers", make_cloth_layers, 4,
           "three cloths fall on a ball that turns; 4 objects"),
    moving("cloth-funnel", make_cloth_funnel, 4,
           "a ball pushes a cloth through a funnel; 4 objects"),
    moving("cloth-dress", make_cloth_dress, 10, "nine skirts in layers round a dancer; 10 objects"),
    moving("n-body", make_n_body, n_body_count,
           "balls fall to their centre and bounce; 305 rigid objects"),
    moving("two-spheres", make_two_spheres, 2,
           "one sphere sinks into another, both turn; 2 rigid objects"),
};

constexpr CrowdGenerator crowds[] = {
    {"bodies", make_bodies, "B:T", 96, 24,
     "B touching balls of T triangles, each an object; a tenth of them moves"},
    {"worlds", make_worlds, "W:B", 96, 24,
     "W worlds of B boxes, an object each: a floor, a robot, and things in piles"},
};

}  // namespace

std::span<const Generator> generators() { return catalog; }

const Generator* generator_called(std::string_view name)
{
    const auto found = std::ranges::find(catalog, name, &Generator::name);
    return found == std::end(catalog) ? nullptr : found;
}

std::span<const CrowdGenerator> crowd_generators() { return crowds; }

const CrowdGenerator* crowd_generator_called(std::string_view name)
{
    const auto found = std::ranges::find(crowds, name, &CrowdGenerator::name);
    return found == std::end(crowds) ? nullptr : found;
}

}  // namespace bvhbench
