// SPDX-License-Identifier: MIT
//
// The narrow phase: which of the pairs that a broad phase found on the device intersect.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "builders/input.h"
#include "builders/stages/kernel_form.h"
#include "collide/narrow/narrow_methods.h"
#include "collide/pairs.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

struct NarrowOptions {
    /// Of collide/narrow/narrow_methods.h. One that rounds may be wrong, and is for measuring how often.
    std::string_view method = "exact";
    /// Whether pairs that share a vertex index are wanted, and then only if they meet beyond what they share.
    /// Without, candidates normally have none; those they have are left out.
    bool keep_adjacent = false;
    KernelForm form = KernelForm::of_device;
    /// Pairs that the buffers of contacts and of unsure candidates have room for at first; 0: a guess. They grow.
    std::size_t capacity = 0;
    /// Decide on the host what floats leave open, as on devices without doubles: `query` then waits. For tests.
    bool without_doubles = false;
};

/// What a query decided, and with what arithmetic: by_floats, by_doubles and exactly add up to the candidates.
struct NarrowCounts {
    std::uint64_t contacts = 0;
    std::uint64_t by_floats = 0;  ///< or by their indices alone
    std::uint64_t by_doubles = 0;
    std::uint64_t exactly = 0;

    std::uint64_t candidates() const { return by_floats + by_doubles + exactly; }
};

/// Decides for each candidate whether its triangles intersect, exactly for the coordinates as stored, all of which
/// must be finite; by a method that rounds, as it may happen to come out.
///
/// Triangles are closed sets: touching is intersecting. One without area is the segment or point that it is. Two
/// that share vertices by index touch by construction, and count only if they have more in common than the vertex or
/// edge they share; the same three indices are the same triangle twice, which counts. Vertices at one place under
/// two indices are not shared. docs/contacts.md has the rest.
///
/// The host never learns how many candidates there are: what a broad phase left is read where it is. As in a
/// collider, nothing is dropped in silence: a query is repeated until it is `complete`.
class NarrowPhase {
public:
    /// Throws BadUsage as check_narrow does, and Unavailable for doubles that the device has not.
    NarrowPhase(Programs& programs, const NarrowOptions& options);

    /// Take memory for about as many contacts as there are triangles. Never timed. Throws Unavailable.
    void reserve(std::size_t triangles);

    /// What stands reserved.
    Footprint reserved() const { return arena_ ? arena_->used() : Footprint{}; }

    /// Enqueue the stage `narrow` over candidates in any order, counted at PAIRS_COUNT of their counters.
    /// Candidates that found no room themselves are not looked at: complete the broad phase first.
    /// Allocates nothing and, on devices with doubles, does not wait.
    void query(const Input& input, const Buffer<Pair>& candidates,
               const Buffer<uint>& candidate_counters, Queue& queue);

    /// Whether everything the last query found had room; if not, there is more now. Waits.
    bool complete(const Queue& queue);

    /// Of the last query, which was complete. Both wait.
    NarrowCounts counts(const Queue& queue) const;
    std::vector<Pair> contacts(const Queue& queue) const;

private:
    bool by_groups() const { return form_ == KernelForm::groups; }
    cl::Kernel compiled_filter(const NarrowMethod& method);
    std::size_t group_count(std::size_t candidates) const;
    void take_all();
    void decide_on_host(const Input& input, Queue& queue);

    Programs& programs_;
    NarrowOptions options_;
    KernelForm form_;
    bool has_doubles_;
    bool is_exact_;
    std::size_t chunks_;
    uint group_size_ = 1;
    uint block_pairs_ = 0;  ///< of each kind, that a work-item of the form for few cores collects
    std::size_t contact_room_ = 0, unsure_room_ = 0;
    std::optional<Arena> arena_;
    cl::Kernel filter_;
    cl::Kernel exact_;
    Buffer<Pair> contacts_;
    Buffer<Pair> unsure_;    ///< candidates that wait for exact arithmetic
    Buffer<Pair> blocks_;    ///< of the form for few cores
    Buffer<uint> counters_;  ///< as collide/narrow/narrow_words.h says
};

/// Query until it is complete; how many queries that took. Waits.
int find_contacts(NarrowPhase& narrow, const Input& input, const Buffer<Pair>& candidates,
                  const Buffer<uint>& candidate_counters, Queue& queue);

}  // namespace bvhbench
