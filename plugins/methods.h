// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "builders/builder.h"
#include "collide/collider.h"
#include "plugins/process.h"

namespace bvhbench::outside {

/// A method that stands in the catalogs, and what its processes may take. The library must outlive what is made of it.
struct Offer {
    const Library& library;
    const Method& method;
    Limits limits = {};
};

/// Makes a builder of a method with `build` and `tree`. Like all builders, it counts what the method says it holds.
std::unique_ptr<Builder> make_builder(const Offer& offer);

/// Makes a collider of a method with `query`. A query includes the method's build or, if `refits`, its refit. With a distance the collider
/// finds contacts, the pairs within it. Throws BadUsage for pairs that the method does not say it finds, here or when it reserves.
std::unique_ptr<Collider> make_collider(const Offer& offer, bool refits, const Device& device,
                                        const ColliderOptions& options,
                                        std::optional<double> distance);

}  // namespace bvhbench::outside
