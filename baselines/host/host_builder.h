// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "builders/builder.h"

namespace bvhbench {

/// A hierarchy over boxes, made on the host: what is left of a builder when the leaf boxes are given.
class HostMethod {
public:
    virtual ~HostMethod() = default;

    virtual BuilderCard card() const = 0;

    /// Bytes for `primitives` boxes, the boxes themselves left out. Host memory.
    virtual Footprint footprint(std::size_t primitives) const = 0;

    /// Allocate what `footprint` counts.
    virtual void reserve(std::size_t primitives) = 0;

    /// Put the boxes where `build` wants them. Not timed: a program that has no other use for its boxes
    /// writes them there at once. They stay where they are until the next call. Throws Unavailable for
    /// boxes that the method cannot take.
    virtual void accept(std::span<const Aabb> boxes) = 0;

    /// Build over the boxes last accepted: box k is triangle k's. Timed.
    virtual void build() = 0;

    virtual const Tree& tree() const = 0;
};

/// The builder with the stages bounds and hierarchy, both on the host. It has no codes: a start from sorted
/// leaves is a start from leaf boxes, and their order is the method's business.
std::unique_ptr<Builder> make_host_builder(std::unique_ptr<HostMethod> method);

}  // namespace bvhbench
