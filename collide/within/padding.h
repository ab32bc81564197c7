// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "builders/input.h"
#include "builders/stages/kernel_form.h"
#include "device/arena.h"
#include "device/program.h"

namespace bvhbench {

/// Room around each vertex, or around its way in a step: boxes of what comes within a distance then overlap.
class Padding {
public:
    Padding(Programs& programs, KernelForm form, bool of_step);

    /// Reserves memory to pad `points`. Never timed. Throws Unavailable.
    void reserve(std::size_t points);

    /// Memory reserved at present.
    Footprint reserved() const { return arena_ ? arena_->used() : Footprint{}; }

    /// Gives each vertex `reach` to each side, in the stage `pad`. Returns the input for builders and colliders on the device: swept, over
    /// the ends of the rooms; its host points are not those. Does not block.
    Input padded(const Input& input, float reach, Queue& queue);

private:
    Programs& programs_;
    KernelForm form_;
    bool of_step_;
    cl::Kernel kernel_;
    std::optional<Arena> arena_;
    Buffer<Point> low_ends_, high_ends_;
};

/// Returns a float that is at least half of the distance: the room to each side.
float reach_of(double distance);

/// Returns a distance that is that of the vertices as they are rounded to floats, if they are doubles: at least `distance`.
double distance_of_floats(const Input& input, double distance);

}  // namespace bvhbench
