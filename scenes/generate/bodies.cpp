// SPDX-License-Identifier: MIT
#include "scenes/generate/film.h"
#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

constexpr uint n_body_steps = 1600;
constexpr double step_s = 1.0 / 640;
constexpr double pull = 6;       // acceleration towards the centre per unit of distance
constexpr double drag = 0.25;    // relative loss of speed per second
constexpr double bounce = 0.85;  // fraction of the speed that remains after a collision
// Bodies collide slightly below their surfaces, as in a simulation with long steps, so their triangles do overlap.
constexpr double below = 0.985;

/// A rotation as a quaternion w + (x, y, z).
struct Attitude {
    double w = 1;
    Vector v = {};

    Vector operator()(Vector a) const
    {
        const Vector twice = 2 * cross(v, a);
        return a + w * twice + cross(v, twice);
    }
    /// Returns the attitude after `seconds` of rotation by `spin` radians per second about the direction of `spin`.
    Attitude advanced(Vector spin, double seconds) const
    {
        const Vector half = (0.5 * seconds) * spin;
        const Attitude next = {w - dot(half, v), v + w * half + cross(half, v)};
        const double size = 1 / std::sqrt(next.w * next.w + dot(next.v, next.v));
        return {size * next.w, size * next.v};
    }
};

struct Body {
    double radius;
    Vector at = {}, velocity = {}, spin = {};
    Attitude attitude;
};

std::vector<Body> strewn_bodies()
{
    Random random(n_body_count);
    std::vector<Body> bodies;
    while (bodies.size() < n_body_count) {
        Body body{0.045 + 0.02 * random.unit(),
                  vector_of(random.in_ball()),
                  0.5 * vector_of(random.in_ball()),
                  4 * vector_of(random.in_ball()),
                  {}};
        bool is_free = true;
        for (const Body& other : bodies)
            is_free = is_free && length(other.at - body.at) > other.radius + body.radius;
        if (is_free)
            bodies.push_back(body);
    }
    return bodies;
}

/// Separates two overlapping bodies and lets them bounce off each other; the heavier one moves less.
void meet(Body& a, Body& b)
{
    const Vector between = b.at - a.at;
    const double reach = below * (a.radius + b.radius);
    const double square = dot(between, between);
    if (square >= reach * reach || !(square > 0))
        return;
    const double distance = std::sqrt(square);
    const Vector normal = (1 / distance) * between;
    const double mass_a = a.radius * a.radius * a.radius, mass_b = b.radius * b.radius * b.radius;
    const double share_a = mass_b / (mass_a + mass_b), share_b = 1 - share_a;
    const double depth = reach - distance;
    a.at = a.at - (share_a * depth) * normal;
    b.at = b.at + (share_b * depth) * normal;
    const double closing = dot(a.velocity - b.velocity, normal);
    if (closing <= 0)
        return;
    a.velocity = a.velocity - ((1 + bounce) * closing * share_a) * normal;
    b.velocity = b.velocity + ((1 + bounce) * closing * share_b) * normal;
}

void advance(std::vector<Body>& bodies)
{
    for (Body& body : bodies) {
        body.velocity = (1 - drag * step_s) * (body.velocity - (pull * step_s) * body.at);
        body.at = body.at + step_s * body.velocity;
        body.attitude = body.attitude.advanced(body.spin, step_s);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t j = i + 1; j < bodies.size(); ++j)
            meet(bodies[i], bodies[j]);
}

constexpr uint sphere_steps = 1000;
constexpr double sphere_radius = 0.5;
// Distances between centres; the spheres touch at 1. At the end a twentieth of each surface is inside the other sphere.
constexpr double first_distance = 1.025, last_distance = 0.9;
constexpr double turns = 0.25;  // of each sphere by the end, in opposite directions

}  // namespace

Scene make_n_body(uint triangles, uint frames)
{
    std::vector<Body> bodies = strewn_bodies();
    const std::vector<uint> shares = even_shares(triangles, n_body_count);
    Film film;
    for (uint k = 0; k < n_body_count; ++k)
        film.add("body " + std::to_string(k), make_sphere(shares[k]), [&bodies, k](Point at) {
            const Body& body = bodies[k];
            return body.at + body.attitude(body.radius * vector_of(at));
        });
    return film.shoot(frames, n_body_steps, [&](uint) { advance(bodies); });
}

Scene make_two_spheres(uint triangles, uint frames)
{
    const std::vector<uint> shares = even_shares(triangles, 2);
    const Vector along = {0.9, 0.3, 0.316};  // nearly a unit vector, not aligned with any axis
    double part = 0;                         // fraction of the distance covered so far
    Film film;
    film.add("standing", make_sphere(shares[0]), [&part](Point at) {
        return turned(sphere_radius * vector_of(at), turn_of(turns * part));
    });
    film.add("coming", make_sphere(shares[1]), [&part, along](Point at) {
        const double distance = first_distance + part * (last_distance - first_distance);
        return distance * along +
               turned(sphere_radius * vector_of(at), turn_of(0.1 - turns * part));
    });
    return film.shoot(frames, sphere_steps,
                      [&part](uint step) { part = (step + 1.0) / sphere_steps; });
}

}  // namespace bvhbench
