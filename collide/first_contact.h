// SPDX-License-Identifier: MIT
#pragma once

#include "builders/input.h"
#include "collide/collider.h"

namespace bvhbench {

/// What `leaf` adds to its walk for ColliderOptions::first: the pairs that floats and doubles leave unsure, and their exact test.
class FirstContact {
public:
    /// `room` is the first capacity of the list of unsure pairs.
    FirstContact(Programs& programs, const ColliderOptions& options, uint group_size,
                 std::size_t room);

    /// What the walk's kernel needs to know: whether it decides pairs in doubles.
    Define define() const { return {"WITH_DOUBLES", has_doubles_ ? 1u : 0u}; }

    void plan(Arena& arena) { unsure_ = arena.take<Pair>(room_, Use::scratch); }

    const Buffer<Pair>& unsure() const { return unsure_; }
    uint room() const { return static_cast<uint>(unsure_.size()); }

    /// Enqueues the test of the unsure pairs up to the first contact, which becomes the only one of `pairs`. Blocks on devices without
    /// doubles.
    void decide(const Input& input, Buffer<Pair>& pairs, Buffer<uint>& counters, Queue& queue);

    /// True if `count` unsure pairs fitted; otherwise the next `plan` takes more.
    bool make_room(std::uint64_t count);

private:
    void decide_on_host(const Input& input, Buffer<Pair>& pairs, Buffer<uint>& counters,
                        const Queue& queue) const;

    const Device& device_;
    bool has_doubles_, keeps_adjacent_;
    std::size_t room_, items_, group_size_ = 1;
    cl::Kernel decide_;
    Buffer<Pair> unsure_;
};

}  // namespace bvhbench
