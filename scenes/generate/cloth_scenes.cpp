// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenes/generate/cloth.h"
#include "scenes/generate/film.h"
#include "scenes/generate/generators.h"

namespace bvhbench {
namespace {

/// Returns the number of simulated cells along a side of a square sheet of `triangles` triangles: no more than are drawn, but
/// enough to fall like cloth.
uint sheet_cells(uint triangles, uint most)
{
    const auto drawn = static_cast<uint>(std::sqrt(0.5 * triangles));
    return std::clamp<uint>(drawn, 8, most);
}

/// Returns a point on the surface of `lathe`: u runs around it, v down its profile.
Vector on_lathe(const Lathe& lathe, Point at)
{
    const double low = lathe.profile.front().height, high = lathe.profile.back().height;
    const double height = high - at.y * (high - low);
    const auto surface = lathe.radius_at(std::clamp(height, low, high));
    const Turn turn = turn_of(at.x);
    const double radius = surface ? surface->first : 0;
    return lathe.placement.place({radius * turn.cosine, height, radius * turn.sine});
}

/// Cloth among obstacles, which must outlive the stage, and the film of both.
struct Stage {
    Cloth cloth;
    std::vector<const Obstacle*> obstacles;
    Film film = {};

    /// Adds a square sheet of cloth at `position(u, v)`.
    void add_square(const std::string& name, uint triangles, uint cells,
                    const std::function<Vector(double u, double v)>& position)
    {
        show(name, make_sheet(triangles, 1, false), cloth.add(cells, cells, false, position));
    }
    void show(const std::string& name, Mesh mesh, const Sheet& sheet)
    {
        film.add(name, std::move(mesh),
                 [this, sheet](Point at) { return cloth.surface(sheet, at.x, at.y, obstacles); });
    }
    void show(const std::string& name, Mesh mesh, const Lathe& lathe)
    {
        film.add(name, std::move(mesh), [&lathe](Point at) { return on_lathe(lathe, at); });
    }
    void show(const std::string& name, Mesh mesh, const Ball& ball)
    {
        film.add(name, std::move(mesh),
                 [&ball](Point at) { return ball.placement.place(ball.radius * vector_of(at)); });
    }
};

constexpr uint ball_steps = 2800;
constexpr uint turns_from = 500;  // by this step the cloth lies on the ball

/// Returns the scene of sheets with the given numbers of triangles above a ball on the floor.
Scene cloth_on_ball(const std::vector<uint>& sheets, uint most_columns, double apart,
                    uint ball_triangles, uint frames)
{
    Ball ball;
    ball.radius = 0.15;
    ball.placement.centre = {0, ball.radius, 0};
    const Floor floor;
    const ClothSettings settings = {.bend = 1e-4, .friction = 1, .apart = apart};
    Stage stage{Cloth(settings), {&ball, &floor}};
    for (uint k = 0; k < sheets.size(); ++k)
        stage.add_square(sheets.size() == 1 ? "cloth" : "cloth " + std::to_string(k), sheets[k],
                         sheet_cells(sheets[k], most_columns), [&](double u, double v) {
                             return turned({u - 0.5, 0, v - 0.5}, turn_of(0.04 * k)) +
                                    Vector{0.02, 0.36 + 0.025 * k, 0.013};
                         });
    stage.show("ball", make_sphere(ball_triangles), ball);
    return stage.film.shoot(frames, ball_steps, [&](uint step) {
        const double faster = step < turns_from ? 0 : 0.01 * (step - turns_from);
        ball.placement.spin = std::min(faster, 5.0);
        ball.placement.advance(settings.step_s);
        stage.cloth.step(stage.obstacles);
    });
}

constexpr uint dress_steps = 2000;
constexpr uint skirts = 9;
constexpr double skirt_length = 0.45;

const std::vector<Lathe::Ring> body_profile = {
    {0.06, 0.0},  {0.07, 0.1},  {0.11, 0.5}, {0.17, 0.9},  {0.12, 1.1},  {0.16, 1.3}, {0.16, 1.38},
    {0.05, 1.45}, {0.05, 1.52}, {0.1, 1.58}, {0.11, 1.66}, {0.07, 1.74}, {0.03, 1.76}};

/// Returns a point of skirt k (three layers at each of three heights) without rotation: v runs down, and folds deepen.
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

/// Moves the dancer, who turns in one direction, in the other, and back, and sways.
void dance(Placement& body, uint step, double step_s)
{
    const double t = static_cast<double>(step) / dress_steps;
    body.spin = 4.5 * turn_of(1.25 * t).sine;
    body.velocity = {0.5 * turn_of(1.5 * t).cosine, 0, 0.3 * turn_of(2 * t).sine};
    body.advance(step_s);
}

constexpr uint funnel_steps = 2400;
constexpr double mouth = 0.62, neck = 0.1;
constexpr double cloth_side = 0.85;
constexpr double thickness = 0.0075;  // maximum: more of the cloth would not fit through the neck

}  // namespace

Scene make_cloth_ball(uint triangles, uint frames)
{
    const uint ball = even_part(triangles, triangles < 4000 ? 0.2 : 0.00824, 1);
    // With 0.5 a single sheet folds more tightly; it penetrates itself in few places.
    return cloth_on_ball({triangles - ball}, 110, 0.5, ball, frames);
}

Scene make_cloth_layers(uint triangles, uint frames)
{
    const uint ball = even_part(triangles, triangles < 4000 ? 0.2 : 0.00824, 3);
    // 0.8 is enough to keep sheets apart, except in a few places.
    return cloth_on_ball(even_shares(triangles - ball, 3), 70, 0.8, ball, frames);
}

Scene make_cloth_dress(uint triangles, uint frames)
{
    Lathe body;
    body.profile = body_profile;
    const Floor floor;
    const uint body_triangles = even_part(triangles, 0.1, skirts);
    const std::vector<uint> shares = even_shares(triangles - body_triangles, skirts);

    ClothSettings settings;
    settings.drag = 1;
    settings.apart = 0.5;  // layers are attached closer to each other than the width of a cell
    Stage stage{Cloth(settings), {&body, &floor}};
    Cloth& cloth = stage.cloth;
    stage.show("body", make_sheet(body_triangles, 0.7, true), body);
    std::vector<Sheet> sheets;
    for (uint k = 0; k < skirts; ++k) {
        const uint rows = std::clamp<uint>(sheet_cells(shares[k], 40) / 2, 5, 18);
        sheets.push_back(cloth.add(4 * rows + 4, rows, true,
                                   [&](double u, double v) { return skirt_point(body, k, u, v); }));
        for (uint i = 0; i < sheets[k].columns; ++i)
            cloth.pin(sheets[k].particle(i, 0));
        stage.show("skirt " + std::to_string(k), make_sheet(shares[k], 4, true), sheets[k]);
    }
    return stage.film.shoot(frames, dress_steps, [&](uint step) {
        dance(body.placement, step, settings.step_s);
        for (uint k = 0; k < skirts; ++k)
            for (uint i = 0; i < sheets[k].columns; ++i)
                cloth.place(sheets[k].particle(i, 0),
                            body.placement.place(skirt_point(
                                body, k, static_cast<double>(i) / sheets[k].columns, 0)));
        cloth.step(stage.obstacles);
    });
}

// The ball moves down at constant speed, through the neck and almost to the floor, with the cloth between ball and funnel.
Scene make_cloth_funnel(uint triangles, uint frames)
{
    const Floor floor;
    Ball ball;
    ball.radius = 0.075;
    ball.placement.centre = {0, 0.9, 0};
    ball.placement.velocity = {0, -0.33, 0};
    Lathe funnel;
    funnel.is_wall = true;
    funnel.placement.centre = {0, 0.35, 0};
    funnel.profile = {{neck, 0}, {neck, 0.12}, {mouth, 0.42}};

    const uint rest = even_part(triangles, triangles < 4000 ? 0.3 : 0.1, 1);
    const uint floor_triangles = std::max(1u, std::min(rest / 8, 2u));
    const std::vector<uint> shares = even_shares(std::max(rest, 3u) - floor_triangles, 2);
    const uint cloth_triangles = triangles - shares[0] - shares[1] - floor_triangles;

    const uint cells = sheet_cells(cloth_triangles, 90);
    ClothSettings settings;
    settings.friction = 0.9;
    settings.apart = std::min(0.8, thickness / cloth_side * cells);
    Stage stage{Cloth(settings), {&floor, &ball, &funnel}};
    stage.add_square("cloth", cloth_triangles, cells, [](double u, double v) {
        return Vector{cloth_side * (u - 0.5) + 0.01, 0.8, cloth_side * (v - 0.5) + 0.006};
    });
    stage.show("funnel", make_sheet(shares[0], 3, true), funnel);
    stage.show("ball", make_sphere(shares[1]), ball);
    stage.film.add("floor", make_sheet(floor_triangles, 1, false), [](Point at) {
        return Vector{2.0 * (at.x - 0.5), 0, 2.0 * (at.y - 0.5)};
    });
    return stage.film.shoot(frames, funnel_steps, [&](uint) {
        ball.placement.advance(settings.step_s);
        stage.cloth.step(stage.obstacles);
    });
}

}  // namespace bvhbench
