// SPDX-License-Identifier: MIT
//
// Two trees that were built apart, put side by side as those of two objects of one frame: what colliders query.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <tuple>

#include "builders/implicit/tree.h"
#include "collide/collider.h"
#include "device/arena.h"
#include "library/device.h"

namespace bvhbench::oibvh {

/// Copies of both trees, of which the second's leaves are numbered behind the first's.
class JoinedTrees {
public:
    explicit JoinedTrees(Device::Impl& device) : device_(device) {}

    /// Find the pairs of a leaf of `a` with one of `b`, each with the numbers of its own tree. Takes memory for trees of
    /// other sizes than before. The collider that is returned has them until the next call. Waits. Throws BadUsage for
    /// trees of several objects, or whose leaves are not kept alike.
    Collider& find_pairs(const ImplicitTree& a, const ImplicitTree& b, std::string_view collider);

    std::size_t memory() const;

private:
    void reserve(const ImplicitTree& a, const ImplicitTree& b, std::string_view collider);
    void plan(Arena& arena, const ImplicitTree& a, const ImplicitTree& b);
    void enqueue_copies(const ImplicitTree& a, const ImplicitTree& b);
    void enqueue_own_numbers();

    Device::Impl& device_;
    cl::Kernel number_, own_numbers_;
    std::optional<Arena> arena_;
    ImplicitTree tree_;
    std::unique_ptr<Collider> collider_;
    std::tuple<uint, uint, bool> reserved_for_ =
        {};  ///< leaves of both, and whether they are sorted
};

}  // namespace bvhbench::oibvh
