// SPDX-License-Identifier: MIT
#include "scenes/generate/obstacles.h"

namespace bvhbench {

std::optional<Contact> Floor::contact(Vector at) const
{
    if (at.y >= gap)
        return std::nullopt;
    return Contact{{0, 1, 0}, gap - at.y, {}};
}

void Placement::advance(double seconds)
{
    centre = centre + seconds * velocity;
    const double half = 0.5 * seconds * spin;  // approximates the tangent of half the angle
    const double scale = 1 / (1 + half * half);
    const Turn by = {(1 - half * half) * scale, 2 * half * scale};
    const Turn next = {turn.cosine * by.cosine - turn.sine * by.sine,
                       turn.sine * by.cosine + turn.cosine * by.sine};
    const double size = std::sqrt(next.cosine * next.cosine + next.sine * next.sine);
    turn = {next.cosine / size, next.sine / size};
}

Vector Placement::velocity_at(Vector at) const
{
    const Vector arm = at - centre;
    return velocity + Vector{spin * arm.z, 0, -spin * arm.x};
}

std::optional<Contact> Ball::contact(Vector at) const
{
    const Vector arm = at - placement.centre;
    const double reach = radius + gap;
    const double square = dot(arm, arm);
    if (square >= reach * reach)
        return std::nullopt;
    const double distance = std::sqrt(square);
    const Vector normal = distance > 0 ? (1 / distance) * arm : Vector{0, 1, 0};
    return Contact{normal, reach - distance, placement.velocity_at(at)};
}

std::optional<std::pair<double, double>> Lathe::radius_at(double height) const
{
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
        const Ring low = profile[k], high = profile[k + 1];
        if (height < low.height || height > high.height)
            continue;
        const double slope = (high.radius - low.radius) / (high.height - low.height);
        return std::pair{low.radius + slope * (height - low.height), slope};
    }
    return std::nullopt;
}

std::optional<Contact> Lathe::contact(Vector at) const
{
    const Vector arm = at - placement.centre;
    const auto surface = radius_at(arm.y);
    if (!surface)
        return std::nullopt;
    const auto [radius, slope] = *surface;
    const double distance = std::sqrt(arm.x * arm.x + arm.z * arm.z);
    const double lean = 1 / std::sqrt(1 + slope * slope);
    const double side = is_wall ? -1 : 1;
    const double depth = side * (radius - distance) * lean + gap;
    if (depth <= 0)
        return std::nullopt;
    const double x = distance > 0 ? arm.x / distance : 1;
    const double z = distance > 0 ? arm.z / distance : 0;
    return Contact{(side * lean) * Vector{x, -slope, z}, depth, placement.velocity_at(at)};
}

}  // namespace bvhbench
