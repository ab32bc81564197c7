// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "scenes/generate/vector.h"

namespace bvhbench {

/// How deep a point is in an obstacle, and how the obstacle moves there.
struct Contact {
    Vector normal = {};  ///< of length 1, the way out
    double depth = 0;
    Vector velocity = {};
};

/// Something hard that cloth lies on. All keep cloth `gap` away from their surface.
class Obstacle {
public:
    static constexpr double gap = 0.003;

    virtual ~Obstacle() = default;
    /// Nothing where `at` is outside.
    virtual std::optional<Contact> contact(Vector at) const = 0;
};

/// Everything below height 0.
struct Floor : Obstacle {
    std::optional<Contact> contact(Vector at) const override;
};

/// Where an obstacle is and how it moves: it may turn about the vertical line through its centre.
struct Placement {
    Vector centre = {};
    Vector velocity = {};
    double spin = 0;  ///< radians a second, from z to x
    Turn turn;        ///< how far it has turned

    /// Moves on by `seconds`; the turn by a rational step, which only sqrt has to set right.
    void advance(double seconds);
    Vector velocity_at(Vector at) const;
    /// Where a point of the thing goes that is at `local` from an unturned centre.
    Vector place(Vector local) const { return centre + turned(local, turn); }
};

struct Ball : Obstacle {
    Placement placement;
    double radius = 1;
    std::optional<Contact> contact(Vector at) const override;
};

/// A profile turned about its vertical line: solid inside, or a wall that keeps cloth inside.
struct Lathe : Obstacle {
    struct Ring {
        double radius, height;
    };
    Placement placement;
    std::vector<Ring> profile;  ///< upwards
    bool is_wall = false;
    std::optional<Contact> contact(Vector at) const override;
    /// The radius at `height` and how it changes with it; nothing above and below.
    std::optional<std::pair<double, double>> radius_at(double height) const;
};

}  // namespace bvhbench
