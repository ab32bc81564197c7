// SPDX-License-Identifier: MIT
#include "scenes/generate/cloth_scene.h"
#include "scenes/generate/moving.h"

namespace bvhbench {
namespace {

constexpr uint steps = 2800;
constexpr uint turns_from = 500;  // the cloth lies on the ball by then

/// A ball on the floor and sheets above it. Ball and floor last as long as the film.
struct Stage {
    Ball ball;
    Floor floor;
    Cloth cloth;
    std::vector<const Obstacle*> obstacles{&ball, &floor};
    Film film;

    explicit Stage(double apart) : cloth(settings(apart)) {}

    static ClothSettings settings(double apart)
    {
        ClothSettings soft;
        soft.bend = 1e-4;
        soft.friction = 1;
        soft.apart = apart;
        return soft;
    }
    void add_sheet(const std::string& name, uint triangles, uint most_columns, double height,
                   Turn turn)
    {
        const uint cells = sheet_cells(triangles, most_columns);
        const Sheet sheet = cloth.add(cells, cells, false, [&](double u, double v) {
            return turned({u - 0.5, 0, v - 0.5}, turn) + Vector{0.02, height, 0.013};
        });
        film.add(name, make_sheet(triangles, 1, false),
                 [this, sheet](Point at) { return cloth.surface(sheet, at.x, at.y, obstacles); });
    }

    Scene shoot(uint ball_triangles, uint frames)
    {
        ball.radius = 0.15;
        ball.placement.centre = {0, ball.radius, 0};
        film.add("ball", make_sphere(ball_triangles),
                 [this](Point at) { return ball.placement.place(ball.radius * vector_of(at)); });
        return film.shoot(frames, steps, [this](uint step) {
            const double faster = step < turns_from ? 0 : 0.01 * (step - turns_from);
            ball.placement.spin = std::min(faster, 5.0);
            ball.placement.advance(ClothSettings{}.step_s);
            cloth.step(obstacles);
        });
    }
};

}  // namespace

Scene make_cloth_ball(uint triangles, uint frames)
{
    Stage stage(0.5);  // one sheet folds tighter so, and in few places goes through itself
    const uint ball = even_part(triangles, triangles < 4000 ? 0.2 : 0.00824, 1);
    stage.add_sheet("cloth", triangles - ball, 110, 0.36, {});
    return stage.shoot(ball, frames);
}

Scene make_cloth_layers(uint triangles, uint frames)
{
    Stage stage(0.8);  // enough to keep sheets from each other, but for a few places
    const uint ball = even_part(triangles, triangles < 4000 ? 0.2 : 0.00824, 3);
    const std::vector<uint> shares = even_shares(triangles - ball, 3);
    for (uint k = 0; k < 3; ++k)
        stage.add_sheet("cloth " + std::to_string(k), shares[k], 70, 0.36 + 0.025 * k,
                        turn_of(0.04 * k));
    return stage.shoot(ball, frames);
}

}  // namespace bvhbench
