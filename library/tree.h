// SPDX-License-Identifier: MIT
//
// What is behind a Tree: a builder, its tree, and colliders made when they are first asked for.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "builders/builder.h"
#include "builders/implicit/tree.h"
#include "collide/collider.h"
#include "library/input.h"
#include "library/joined.h"

namespace bvhbench::oibvh {

struct Tree::Impl {
    Impl(const std::shared_ptr<Device::Impl>& on, Options asked);

    /// Begin a call that enqueues: behind everything that the caller has enqueued.
    void begin();

    void build(const Input& input, std::span<const std::uint32_t> objects);
    void refit(const Input& input);
    void update(const Input& input, std::span<const Update> updates);

    /// Throws BadUsage if there is none; `what` wants it.
    const ImplicitTree& standing(const char* what) const;

    Pairs find_pairs(Among among);
    Pairs find_pairs(const Impl& other);
    std::vector<Pair> read_pairs() const;

    std::size_t memory() const;

    std::shared_ptr<Device::Impl> device;  ///< outlives all the others
    Options options;
    InputTaker taker;
    std::unique_ptr<Builder> builder;
    std::string_view collider_name;
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

private:
    /// Make the tree that stands anew in part, over input of the same sizes.
    void renew(const Input& input, const std::function<void(const bvhbench::Input&)>& make);
    Pairs found_by(Collider& collider);
};

/// The collider called so, or the device's own. Throws BadUsage if there is none.
std::unique_ptr<Collider> make_collider(Programs& programs, std::string_view name,
                                        const ColliderOptions& options);
std::string_view collider_for(const bvhbench::Device& device, std::string_view asked);

}  // namespace bvhbench::oibvh
