// SPDX-License-Identifier: MIT
#include "scenes/generate/cloth_scene.h"
#include "scenes/generate/moving.h"

namespace bvhbench {
namespace {

constexpr uint steps = 2400;
constexpr double mouth = 0.62, neck = 0.1;
constexpr double cloth_side = 0.85;
constexpr double thickness = 0.0075;  // at most: more of the cloth would not fit the neck

}  // namespace

// The ball goes down at one speed, through the neck and almost to the floor; the cloth is in between.
Scene make_cloth_funnel(uint triangles, uint frames)
{
    Floor floor;
    Ball ball;
    ball.radius = 0.075;
    ball.placement.centre = {0, 0.9, 0};
    ball.placement.velocity = {0, -0.33, 0};
    Lathe funnel;
    funnel.is_wall = true;
    funnel.placement.centre = {0, 0.35, 0};
    funnel.profile = {{neck, 0}, {neck, 0.12}, {mouth, 0.42}};
    const std::vector<const Obstacle*> obstacles = {&floor, &ball, &funnel};

    const uint rest = even_part(triangles, triangles < 4000 ? 0.3 : 0.1, 1);
    const uint floor_triangles = std::max(1u, std::min(rest / 8, 2u));
    const std::vector<uint> shares = even_shares(std::max(rest, 3u) - floor_triangles, 2);
    const uint cloth_triangles = triangles - shares[0] - shares[1] - floor_triangles;

    const uint cells = sheet_cells(cloth_triangles, 90);
    ClothSettings settings;
    settings.friction = 0.9;
    settings.apart = std::min(0.8, thickness / cloth_side * cells);
    Cloth cloth(settings);
    const Sheet sheet = cloth.add(cells, cells, false, [](double u, double v) {
        return Vector{cloth_side * (u - 0.5) + 0.01, 0.8, cloth_side * (v - 0.5) + 0.006};
    });
    Film film;
    film.add("cloth", make_sheet(cloth_triangles, 1, false),
             [&](Point at) { return cloth.surface(sheet, at.x, at.y, obstacles); });
    film.add("funnel", make_sheet(shares[0], 3, true),
             [&](Point at) { return on_lathe(funnel, at); });
    film.add("ball", make_sphere(shares[1]),
             [&](Point at) { return ball.placement.place(ball.radius * vector_of(at)); });
    film.add("floor", make_sheet(floor_triangles, 1, false), [](Point at) {
        return Vector{2.0 * (at.x - 0.5), 0, 2.0 * (at.y - 0.5)};
    });
    return film.shoot(frames, steps, [&](uint) {
        ball.placement.advance(settings.step_s);
        cloth.step(obstacles);
    });
}

}  // namespace bvhbench
