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
#include "collide/object_filter.h"
#include "collide/pairs.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Name and source of a collider, for listings and result files.
struct ColliderCard {
    std::string_view name;    ///< unique and stable: used on the command line and in result files
    std::string_view method;  ///< the publication or library, as cited in docs/references.md
};

/// Options of a query, shared by all colliders. A collider ignores the options that it does not use.
struct ColliderOptions {
    Among among = Among::all;
    /// True to report pairs that share a vertex index as well. Such pairs touch by construction.
    bool keep_adjacent = true;
    /// Levels that a traversal step descends, Eq. (12); 0: the collider chooses.
    unsigned jump = 0;
    /// Level that a traversal starts on; boxes above it are not tested. 0: the collider chooses, usually the root.
    unsigned start_level = 0;
    unsigned rules_off = 0;  ///< SkipRule bits of skips.h that are switched off
    /// Work-items in a work-group, a power of two; 0: the collider chooses, by kind of device.
    unsigned group_size = 0;
    KernelForm form = KernelForm::of_device;
    /// Initial capacity of pair buffers and queues, in entries; 0: estimated. They grow when too small.
    std::size_t capacity = 0;
    /// Pairs of objects that are not tested, for colliders that filter (harness/choice/catalog.h). No other collider may be given a filter.
    ObjectFilter filter = ObjectFilter();

    /// True to end at the first contact: the answer is one pair of triangles that intersect, any of them, or none if no two do. For
    /// `leaf`; no other collider may be asked.
    bool first = false;
    /// True to decide on the host what floats leave open, as on devices without doubles. For tests of `first`.
    bool without_doubles = false;

    bool operator==(const ColliderOptions&) const = default;
};

/// Result and cost of a query. Every query of the same tree gives the same numbers.
struct QueryCounts {
    std::uint64_t pairs = 0;
    std::optional<std::uint64_t> box_tests;  ///< box-box overlap tests, if counted
    std::optional<std::uint64_t> bvtt_peak;  ///< largest queue of node pairs, if any
    std::optional<std::uint64_t> tasks;      ///< tasks between objects, if several
    std::vector<std::pair<std::string_view, std::uint64_t>> more = {};  ///< by counter name
};

/// Pairs in device memory; their number is at PAIRS_COUNT of `counters` (collide/counters.h).
struct DevicePairs {
    Buffer<Pair> pairs;
    Buffer<uint> counters;
    MemoryShare memory = {};  ///< of these buffers, if not counted elsewhere
};

/// Finds all pairs of triangles of a frame whose closed boxes overlap: smaller id first, each pair once.
///
/// A query never drops pairs silently: `complete` tells whether every buffer was large enough, and enlarges those that were not,
/// so that the query can be repeated. `find_pairs` does both.
///
/// Stage names come from a fixed list: ropes, codes, sort, broad, copy; and refit, for colliders with hierarchies of their own.
class Collider {
public:
    virtual ~Collider() = default;

    virtual ColliderCard card() const = 0;

    /// True if the collider queries a builder's tree. Otherwise it is given none, and all its work on the input is part of a
    /// query.
    virtual bool needs_tree() const { return true; }

    /// True if the collider carries state from frame to frame (see `next_frame`) and therefore needs exclusive use of its tree.
    virtual bool keeps_tree() const { return false; }

    /// Moves to the next frame, and returns how its tree must be brought up to date: by a rebuild or a refit, before each query
    /// or once for all queries. Queries start from the state that the last complete query of the previous frame left, however
    /// often they are repeated. Without such a query, or if this is never called, they are queries of a first frame.
    virtual TreeUpdate next_frame() { return TreeUpdate::rebuild; }

    /// True if the collider runs on the host and reads the host's copy of the input.
    virtual bool is_on_host() const { return false; }

    /// True if the collider reports pairs of intersecting triangles rather than pairs of overlapping boxes.
    virtual bool finds_contacts() const { return false; }

    /// Returns the reason why the collider cannot query trees of this kind, as a sentence; empty if it can.
    virtual std::string refusal(const Tree& tree) const = 0;

    /// Compiles for this kind of tree, or for none, and reserves memory for frames like `input`: same faces and objects, any
    /// points. Never timed. Throws Unavailable; throws BadUsage if `refusal` is not empty or the tree does not allow the options.
    virtual void reserve(const Tree* tree, const Input& input) = 0;

    /// Memory reserved at present.
    virtual Footprint reserved() const = 0;

    /// Enqueues one query of the tree that the last build made over `input`. Allocates nothing and does not block.
    virtual void query(const Tree* tree, const Input& input, Queue& queue) = 0;

    /// True if every buffer of the last query was large enough; otherwise enlarges the buffers. Blocks.
    virtual bool complete(const Queue& queue) = 0;

    /// Counts and pairs of the last query, which must have been complete. Both functions block.
    virtual QueryCounts counts(const Queue& queue) const = 0;
    virtual std::vector<Pair> pairs(const Queue& queue) const = 0;

    /// The pairs in device memory, for commands that follow in the queue. A collider on the host copies its pairs there, in a
    /// stage `copy` that blocks. Throws Unavailable if the collider finds contacts itself.
    virtual DevicePairs device_pairs(Queue& queue) = 0;
};

/// Repeats the query until it is complete; returns the number of queries. Blocks.
int find_pairs(Collider& collider, const Tree* tree, const Input& input, Queue& queue);

/// Makes a collider on the device of `programs`. Throws BadUsage for options that the collider does not support.
using MakeCollider = std::unique_ptr<Collider> (*)(Programs& programs,
                                                   const ColliderOptions& options);

// Factories of all colliders. Those of libraries are in baselines/baselines.h.

/// Each leaf walks over the nodes behind it, without a stack.
std::unique_ptr<Collider> make_leaf(Programs& programs, const ColliderOptions& options);

/// Section 5 of the paper: all pairs of nodes, level by level, in two queues between launches.
std::unique_ptr<Collider> make_bvtt(Programs& programs, const ColliderOptions& options);

/// Pairs of nodes, from where the traversal of an earlier frame stopped; boxes are refitted.
std::unique_ptr<Collider> make_front(Programs& programs, const ColliderOptions& options);

/// Each leaf against the tree, from where its walk in an earlier frame stopped [Wang2018]; boxes are refitted.
std::unique_ptr<Collider> make_leaf_front(Programs& programs, const ColliderOptions& options);

/// Neighbouring leaves are one query: a work-group fetches each node once and tests it against each leaf.
std::unique_ptr<Collider> make_group(Programs& programs, const ColliderOptions& options);

/// 32 neighbouring leaves that form a subtree are one query of a warp, which descends five levels at a time. On few cores as `group`.
std::unique_ptr<Collider> make_block(Programs& programs, const ColliderOptions& options);

/// No tree: a hash grid with one level of cells for each size of box.
std::unique_ptr<Collider> make_grid(Programs& programs, const ColliderOptions& options);

/// No tree: each box of an object against each, tile by tile.
std::unique_ptr<Collider> make_all_pairs(Programs& programs, const ColliderOptions& options);

/// No tree: boxes sorted by object and by where they begin along its axis, then a sweep from each [Liu2010].
std::unique_ptr<Collider> make_sort_sweep(Programs& programs, const ColliderOptions& options);

/// No tree: sweep and prune, on the host.
std::unique_ptr<Collider> make_brute(Programs& programs, const ColliderOptions& options);

}  // namespace bvhbench
