// SPDX-License-Identifier: MIT
#include "scenes/generate/cloth_scene.h"
#include "scenes/generate/moving.h"

namespace bvhbench {
namespace {

constexpr uint steps = 2000;
constexpr uint skirts = 9;
constexpr double skirt_length = 0.45;

const std::vector<Lathe::Ring> body_profile = {
    {0.06, 0.0},  {0.07, 0.1},  {0.11, 0.5}, {0.17, 0.9},  {0.12, 1.1},  {0.16, 1.3}, {0.16, 1.38},
    {0.05, 1.45}, {0.05, 1.52}, {0.1, 1.58}, {0.11, 1.66}, {0.07, 1.74}, {0.03, 1.76}};

/// Skirt k of three layers at each of three heights, unturned: v goes down, and folds deepen towards the hem.
Vector skirt_point(const Lathe& body, uint k, double u, double v)
{
    const double top = 1.04 - 0.2 * (k / 3);
    const double out = 0.015 + 0.026 * (k % 3);
    const double fold = 0.06 * v * turn_of(9 * u).cosine;
    const double radius = body.radius_at(top)->first + out + skirt_length * 0.75 * v + fold;
    const Turn turn = turn_of(u);
    const double height = top - skirt_length * (0.66 - 0.015 * (k % 3)) * v;
    return {radius * turn.cosine, height, radius * turn.sine};
}

/// The dancer turns one way, the other, and back, and sways.
void dance(Placement& body, uint step, double step_s)
{
    const double t = static_cast<double>(step) / steps;
    body.spin = 4.5 * turn_of(1.25 * t).sine;
    body.velocity = {0.5 * turn_of(1.5 * t).cosine, 0, 0.3 * turn_of(2 * t).sine};
    body.advance(step_s);
}

}  // namespace

Scene make_cloth_dress(uint triangles, uint frames)
{
    Lathe body;
    body.profile = body_profile;
    Floor floor;
    const std::vector<const Obstacle*> obstacles = {&body, &floor};
    const uint body_triangles = even_part(triangles, 0.1, skirts);
    const std::vector<uint> shares = even_shares(triangles - body_triangles, skirts);

    ClothSettings settings;
    settings.drag = 1;
    settings.apart = 0.5;  // layers are sewn on closer than cells are wide
    Cloth cloth(settings);
    std::vector<Sheet> sheets;
    for (uint k = 0; k < skirts; ++k) {
        const uint rows = std::clamp<uint>(sheet_cells(shares[k], 40) / 2, 5, 18);
        sheets.push_back(cloth.add(4 * rows + 4, rows, true,
                                   [&](double u, double v) { return skirt_point(body, k, u, v); }));
        for (uint i = 0; i < sheets[k].columns; ++i)
            cloth.pin(sheets[k].particle(i, 0));
    }
    Film film;
    film.add("body", make_sheet(body_triangles, 0.7, true),
             [&](Point at) { return on_lathe(body, at); });
    for (uint k = 0; k < skirts; ++k)
        film.add("skirt " + std::to_string(k), make_sheet(shares[k], 4, true),
                 [&, k](Point at) { return cloth.surface(sheets[k], at.x, at.y, obstacles); });
    return film.shoot(frames, steps, [&](uint step) {
        dance(body.placement, step, settings.step_s);
        for (uint k = 0; k < skirts; ++k)
            for (uint i = 0; i < sheets[k].columns; ++i)
                cloth.place(sheets[k].particle(i, 0),
                            body.placement.place(skirt_point(
                                body, k, static_cast<double>(i) / sheets[k].columns, 0)));
        cloth.step(obstacles);
    });
}

}  // namespace bvhbench
