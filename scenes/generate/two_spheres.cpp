// SPDX-License-Identifier: MIT
#include "scenes/generate/film.h"
#include "scenes/generate/generators.h"
#include "scenes/generate/moving.h"

namespace bvhbench {
namespace {

constexpr uint steps = 1000;
constexpr double radius = 0.5;
// Between centres: they touch at 1. At the end a twentieth of each surface is within the other.
constexpr double first_distance = 1.025, last_distance = 0.9;
constexpr double turns = 0.25;  // of each by the end, one against the other

}  // namespace

Scene make_two_spheres(uint triangles, uint frames)
{
    const std::vector<uint> shares = even_shares(triangles, 2);
    const Vector along = {0.9, 0.3, 0.316};  // nearly a unit, and no axis of anything
    double part = 0;                         // of the way that is behind them
    Film film;
    film.add("standing", make_sphere(shares[0]),
             [&part](Point at) { return turned(radius * vector_of(at), turn_of(turns * part)); });
    film.add("coming", make_sphere(shares[1]), [&part, along](Point at) {
        const double distance = first_distance + part * (last_distance - first_distance);
        return distance * along + turned(radius * vector_of(at), turn_of(0.1 - turns * part));
    });
    return film.shoot(frames, steps, [&part](uint step) { part = (step + 1.0) / steps; });
}

}  // namespace bvhbench
