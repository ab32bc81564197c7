// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "builders/builder.h"
#include "builders/input.h"
#include "builders/stages/kernel_form.h"
#include "builders/tree.h"
#include "collide/pairs.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Who a collider is, for listings and result files.
struct ColliderCard {
    std::string_view name;    ///< unique, stable, used on the command line and in result files
    std::string_view method;  ///< the publication or library, as cited in docs/references.md
};

/// How to query. One struct for all colliders: what a collider has no use for it ignores.
struct ColliderOptions {
    Among among = Among::all;
    /// Whether pairs that share a vertex index are wanted too: they touch by construction.
    bool keep_adjacent = true;
    /// Levels a step of a traversal descends, Eq. (12); 0 leaves the choice to the collider.
    unsigned jump = 0;
    /// The level a traversal starts on, so that no box above it is tested; 0 leaves the choice to the collider, usually the root.
    unsigned start_level = 0;
    unsigned rules_off = 0;  ///< of skips.h: work that is done although it need not be
    /// Work-items in a group, a power of two; 0 leaves the choice to the collider, by kind of device.
    unsigned group_size = 0;
    KernelForm form = KernelForm::of_device;
    /// Entries that buffers of pairs and queues have at first; 0: a guess. They grow when they must.
    std::size_t capacity = 0;
};

/// What a query found and took. The same for every query of one tree.
struct QueryCounts {
    std::uint64_t pairs = 0;
    std::optional<std::uint64_t> box_tests;  ///< of two boxes for overlap, if they are counted
    std::optional<std::uint64_t>
        bvtt_peak;                       ///< most entries in a queue of node pairs, if it has any
    std::optional<std::uint64_t> tasks;  ///< held against other objects' trees, if it has several
    std::vector<std::pair<std::string_view, std::uint64_t>> more =
        {};  ///< its own, by counters' names
};

/// Pairs where a query left them, and their number at PAIRS_COUNT of the counters (collide/counters.h).
struct DevicePairs {
    Buffer<Pair> pairs;
    Buffer<uint> counters;
    MemoryShare memory = {};  ///< if it is nobody else's
};

/// Finds the pairs of triangles of a frame whose closed boxes overlap: the smaller id first, each once.
///
/// A query never drops a pair in silence: `complete` tells whether all of them found room, and makes room if
/// not, for the query to be repeated. `find_pairs` does so.
///
/// Stages are words from a fixed list: ropes, broad; and of those with trees of their own hierarchy, refit.
class Collider {
public:
    virtual ~Collider() = default;

    virtual ColliderCard card() const = 0;

    /// Whether it queries a builder's tree. One that does not is handed none, and keeps up with the input itself: all
    /// that takes is part of its query.
    virtual bool needs_tree() const { return true; }

    /// Whether it goes on from frame to frame, as `next_frame` says, and so wants a tree that nobody else builds.
    virtual bool keeps_tree() const { return false; }

    /// Queries from here on are of the frame after the one that was queried last, completely; without such a query, of
    /// a first frame. What its tree must be: rebuilt or refitted, before each of them or once for all. They begin where
    /// that frame left off, however often they are repeated. If it is never called, all are of a first frame.
    virtual TreeUpdate next_frame() { return TreeUpdate::rebuild; }

    /// Whether what it finds are the pairs that intersect, instead of those whose boxes overlap.
    virtual bool finds_contacts() const { return false; }

    /// Why it cannot query trees of this kind, as a sentence; empty if it can.
    virtual std::string refusal(const Tree& tree) const = 0;

    /// Compile for this kind of tree, or none, and take memory for frames like this one: the same faces and objects,
    /// other points. Never timed. Throws Unavailable, and BadUsage for what `refusal` tells or options that the
    /// tree does not allow.
    virtual void reserve(const Tree* tree, const Input& input) = 0;

    /// What stands reserved.
    virtual Footprint reserved() const = 0;

    /// Enqueue one query of the tree that the last build left over `input`. Allocates nothing, does not wait.
    virtual void query(const Tree* tree, const Input& input, Queue& queue) = 0;

    /// Whether everything the last query found had room; if not, there is more now. Waits.
    virtual bool complete(const Queue& queue) = 0;

    /// Of the last query, which was complete. Both wait.
    virtual QueryCounts counts(const Queue& queue) const = 0;
    virtual std::vector<Pair> pairs(const Queue& queue) const = 0;

    /// The same on the device, for what comes behind it in the queue. Of a collider on the host it copies them there, in
    /// a stage `copy` that waits. Throws Unavailable if it finds contacts already.
    virtual DevicePairs device_pairs(Queue& queue) = 0;
};

/// Query until it is complete; how many queries that took. Waits.
int find_pairs(Collider& collider, const Tree* tree, const Input& input, Queue& queue);

/// Makes a collider on the device that `programs` compiles for. Throws BadUsage for options it cannot keep.
using MakeCollider = std::unique_ptr<Collider> (*)(Programs& programs,
                                                   const ColliderOptions& options);

/// Every way to find pairs; docs/architecture.md tells what each does.
std::unique_ptr<Collider> make_leaf(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_bvtt(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_front(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_group(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_block(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_grid(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_brute(Programs& programs, const ColliderOptions& options);

}  // namespace bvhbench
