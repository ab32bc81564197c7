// SPDX-License-Identifier: MIT
//
// What is behind a Tree: a builder, its tree, and colliders made when they are first asked for.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "builders/builder.h"
#include "builders/implicit/tree.h"
#include "collide/collider.h"
#include "library/input.h"

namespace bvhbench::oibvh {

/// What options name: builders or colliders.
template <class Make>
using Named = std::pair<std::string_view, Make>;

/// The one that is called so. Throws BadUsage, which says that `kind` and what there is.
template <class Make, std::size_t count>
const Named<Make>& find_named(const Named<Make> (&all)[count], std::string_view name,
                              const char* kind)
{
    std::string known;
    for (const Named<Make>& one : all) {
        if (one.first == name)
            return one;
        known += (known.empty() ? "" : ", ") + std::string(one.first);
    }
    throw BadUsage(std::string("no ") + kind + " of the library is called '" + std::string(name) +
                   "'; there are: " + known);
}

/// The collider called so, or the device's own.
const Named<MakeCollider>& collider_for(const bvhbench::Device& device, std::string_view asked);

/// Two trees that were built apart, put side by side as those of two objects of one frame: what colliders query. Copies of
/// both, of which the second's leaves are numbered behind the first's.
class JoinedTrees {
public:
    JoinedTrees(Device::Impl& device, MakeCollider make) : device_(device), make_(make) {}

    /// Find the pairs of a leaf of `a` with one of `b`, each with the numbers of its own tree. Takes memory for trees of
    /// other sizes than before. The collider that is returned has them until the next call. Waits. Throws BadUsage for
    /// trees of several objects, or whose leaves are not kept alike.
    Collider& find_pairs(const ImplicitTree& a, const ImplicitTree& b);

    std::size_t memory() const;

private:
    void reserve(const ImplicitTree& a, const ImplicitTree& b);
    void plan(Arena& arena, const ImplicitTree& a, const ImplicitTree& b);
    void enqueue_copies(const ImplicitTree& a, const ImplicitTree& b);
    void enqueue_own_numbers();

    Device::Impl& device_;
    MakeCollider make_;
    cl::Kernel number_, own_numbers_;
    std::optional<Arena> arena_;
    ImplicitTree tree_;
    std::unique_ptr<Collider> collider_;
    /// Leaves of both, and whether they are sorted.
    std::tuple<uint, uint, bool> reserved_for_ = {};
};

struct Tree::Impl {
    Impl(const std::shared_ptr<Device::Impl>& on, Options asked);

    /// Begin a call that enqueues: behind everything that the caller has enqueued.
    void begin();

    /// Make the tree that stands anew in part, over input of the same sizes.
    void renew(const Input& input, const std::function<void(const bvhbench::Input&)>& make);

    /// Throws BadUsage if there is none; `what` wants it.
    const ImplicitTree& standing(const char* what) const;

    /// What the collider's last query found.
    Pairs found_by(Collider& collider);

    std::shared_ptr<Device::Impl> device;  ///< outlives all the others
    Options options;
    InputTaker taker;
    std::unique_ptr<Builder> builder;
    const Named<MakeCollider>& collider;
    std::vector<uint> sizes;             ///< of the objects that there is memory for
    const ImplicitTree* tree = nullptr;  ///< null where none stands

    /// By Among; null if not made, and without memory if not `is_ready`.
    struct Query {
        std::unique_ptr<Collider> collider;
        bool is_ready = false;
    };
    std::array<Query, 3> queries;
    JoinedTrees joined;
    Collider* last_query = nullptr;  ///< that has pairs to be read; of joined trees `joined`'s
};

}  // namespace bvhbench::oibvh
