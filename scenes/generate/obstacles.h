// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "scenes/generate/vector.h"

namespace bvhbench {

/// Penetration of a point into an obstacle, and the obstacle's motion there.
struct Contact {
    Vector normal = {};  ///< outward unit normal
    double depth = 0;
    Vector velocity = {};
};

/// A rigid obstacle for cloth. All obstacles keep cloth `gap` away from their surface.
class Obstacle {
public:
    static constexpr double gap = 0.003;

    virtual ~Obstacle() = default;
    /// Returns the contact at point `at`; nothing if the point is outside.
    virtual std::optional<Contact> contact(Vector at) const = 0;
};

/// The half-space below height 0.
struct Floor : Obstacle {
    std::optional<Contact> contact(Vector at) const override;
};

/// Position and motion of an obstacle, which may rotate about the vertical line through its centre.
struct Placement {
    Vector centre = {};
    Vector velocity = {};
    double spin = 0;  ///< radians per second, from z to x
    Turn turn;        ///< current rotation

    /// Advances by `seconds`. The rotation step uses rational functions; only its normalisation needs sqrt.
    void advance(double seconds);
    Vector velocity_at(Vector at) const;
    /// Returns the position of the point that is at `local` from the centre without rotation.
    Vector place(Vector local) const { return centre + turned(local, turn); }
};

struct Ball : Obstacle {
    Placement placement;
    double radius = 1;
    std::optional<Contact> contact(Vector at) const override;
};

/// Surface of revolution of a profile about its vertical axis: a solid body, or a wall that keeps cloth inside.
struct Lathe : Obstacle {
    struct Ring {
        double radius, height;
    };
    Placement placement;
    std::vector<Ring> profile;  ///< from bottom to top
    bool is_wall = false;
    std::optional<Contact> contact(Vector at) const override;
    /// Returns the radius at `height` and its derivative; nothing above and below the profile.
    std::optional<std::pair<double, double>> radius_at(double height) const;
};

}  // namespace bvhbench
