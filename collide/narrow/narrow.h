// SPDX-License-Identifier: MIT
//
// The narrow phase: decides which of the pairs that a broad phase found on the device intersect, or touch between two frames.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "builders/input.h"
#include "builders/stages/kernel_form.h"
#include "collide/collider.h"
#include "collide/narrow/exact_contact.h"
#include "collide/narrow/narrow_methods.h"
#include "collide/pairs.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

struct NarrowOptions {
    /// A name of collide/narrow/narrow_methods.h. Rounded methods can be wrong; they exist to measure how often. Those for swept
    /// boxes miss nothing.
    std::string_view method = "exact";
    /// True to report pairs that share a vertex index if they meet beyond what they share. False to leave such pairs out; the
    /// candidates normally contain none then.
    bool keep_adjacent = false;
    KernelForm form = KernelForm::of_device;
    /// Initial capacity of the buffers of contacts and of unsure candidates, in pairs; 0: estimated. They grow when too small.
    std::size_t capacity = 0;
    /// True to decide on the host what floats leave open, as on devices without doubles; `query` then blocks. For tests.
    bool without_doubles = false;
    /// Of a swept input: the longest side of the box around both frames, which tolerances are shares of. Must be set for the
    /// methods for swept boxes, and for no others.
    std::optional<float> swept_size = std::nullopt;
    /// Of a swept input: features touch that come as near as this, in the unit of the points. Boxes of candidates must have room for it
    /// (within/padding.h).
    double separation = 0;
    /// Of a swept input: whether its vertices are in doubles (Input::is_wide), which only methods in doubles read.
    bool is_wide = false;
};

/// Results of a query, by the arithmetic that decided: by_floats, by_doubles and exactly add up to the candidates.
struct NarrowCounts {
    std::uint64_t contacts = 0;
    std::uint64_t by_floats = 0;  ///< in floats, or by indices alone
    std::uint64_t by_doubles = 0;
    /// Or not at all: what filters alone left open, and took for contacts.
    std::uint64_t exactly = 0;

    std::uint64_t candidates() const { return by_floats + by_doubles + exactly; }
};

/// Decides for each candidate whether its triangles intersect: exactly for the coordinates as stored, all of which must be
/// finite. Rounded methods give whatever their arithmetic yields. Filters alone find a pair that their error bounds leave open: they
/// miss none, and never wait for the host.
///
/// Triangles are closed sets: touching is intersecting. A triangle without area is the segment or point that it degenerates to.
/// Two triangles that share vertices by index touch by construction, and intersect only if they have more in common than the
/// shared vertex or edge. Triangles with the same three indices are the same triangle twice and intersect. Vertices at one
/// position with two indices are not shared. docs/contacts.md has the details.
///
/// Methods for swept boxes decide which vertices touch which faces, or edges which edges, stored as in scenes/ground_truth.h,
/// while all vertices move in straight lines from one frame to the next, or come as near as a separation. No pair that touches is
/// missed; one that does not may be found if it comes nearer than the tolerance or too near to tell. Pairs that share a vertex are
/// left out. docs/swept.md has the details.
///
/// The number of candidates stays on the device. No contact is dropped silently: a query is repeated until it is `complete`.
class NarrowPhase {
public:
    /// Throws BadUsage as check_narrow and check_narrow_of do, for a method in floats over doubles and for a separation that is no length
    /// or not of a swept input, and Unavailable if the method needs doubles or denormals that the device lacks.
    NarrowPhase(Programs& programs, const NarrowOptions& options);

    /// Reserves memory for about as many contacts as triangles. Never timed. Throws Unavailable.
    void reserve(std::size_t triangles);

    /// True of methods for swept boxes.
    bool is_swept() const { return options_.swept_size.has_value(); }
    double separation() const { return options_.separation; }

    /// Memory reserved at present.
    Footprint reserved() const { return arena_ ? arena_->used() : Footprint{}; }

    /// Enqueues the stage `narrow` over candidates in any order, whose number is at PAIRS_COUNT of their counters. Candidates
    /// beyond their buffer are not tested: repeat the query if the broad phase was not complete. Allocates nothing; does not block on
    /// devices with doubles.
    void query(const Input& input, const Buffer<Pair>& candidates,
               const Buffer<uint>& candidate_counters, Queue& queue);

    /// True if every buffer of the last query was large enough and all that its filter left open was decided. Otherwise enlarges buffers
    /// that were too small; the next query decides what is left open. Blocks.
    bool complete(const Queue& queue);

    /// Counts and contacts of the last query, which must have been complete. Both functions block.
    NarrowCounts counts(const Queue& queue) const;
    std::vector<Pair> contacts(const Queue& queue) const;

    /// Contacts in device memory, to which others may be appended between a query and `complete`, which then counts these too.
    DevicePairs device_contacts() const { return {contacts_, counters_}; }

    /// For each of contacts(), a time from 0 to 1 before which it does not touch, in units of the step. Only of methods for swept
    /// boxes. Blocks.
    std::vector<float> impact_times(const Queue& queue) const;

private:
    bool by_groups() const { return form_ == KernelForm::groups; }
    cl::Kernel compiled_filter(const NarrowMethod& method);
    cl::Kernel compiled_impacts(const NarrowMethod& method);
    std::size_t items_for(std::size_t pairs, std::size_t groups_per_unit) const;
    void take_all();
    void find_impacts(const Input& input, const Buffer<Pair>& candidates,
                      const Buffer<uint>& candidate_counters, Queue& queue);
    void decide_on_host(const Input& input, Queue& queue);

    Programs& programs_;
    NarrowOptions options_;
    KernelForm form_;
    bool has_doubles_;
    bool is_filter_, is_exact_;
    float tolerance_ = 0;  ///< a length, for methods for swept boxes
    std::size_t chunks_;
    uint group_size_ = 1;
    uint block_pairs_ = 0;  ///< pairs of each kind that a work-item of the chunk form buffers
    std::size_t contact_room_ = 0, unsure_room_ = 0;
    std::optional<Arena> arena_;
    cl::Kernel filter_;
    cl::Kernel rest_;            ///< of a filter: decides what it left open
    bool launched_rest_ = true;  ///< in the last query
    uint decided_in_row_ = 0;    ///< queries whose filter left nothing open, since one that did
    Buffer<Pair> contacts_;
    Buffer<float> times_;  ///< of contacts, for methods for swept boxes
    Buffer<Pair> unsure_;  ///< candidates that a filter left open
    Buffer<Pair> blocks_;  ///< blocks of the chunk form
    /// Counters of the last query, and those of the next, which a query zeroes; layout: collide/narrow/narrow_words.h.
    Buffer<uint> counters_, next_counters_;
    std::vector<std::uint64_t> counts_;  ///< of the last query, since it was found complete
};

/// True if the device computes in doubles.
bool has_doubles(const Device& device);

Corners corners_of(std::span<const Point> points, Face face);

/// True if two triangles intersect, exactly. With `keep_adjacent`, beyond the corners that they share by index.
bool triangles_meet(std::span<const Point> points, std::span<const Face> faces, Pair pair,
                    bool keep_adjacent);

/// Appends pairs that the host found to a list with `found` pairs, as many as it has room for, and counts all at CONTACTS_COUNT. Blocks.
void append_found(std::span<const Pair> more, std::uint64_t found, const DevicePairs& list,
                  const Queue& queue);

/// Repeats the query until it is complete. Blocks.
void find_contacts(NarrowPhase& narrow, const Input& input, const Buffer<Pair>& candidates,
                   const Buffer<uint>& candidate_counters, Queue& queue);

/// Returns the bytes of the faces and points of all triangles in `pairs`, each counted once, points of a swept input in both
/// frames: the least that a narrow phase must read (docs/counters.md, Bytes moved).
std::int64_t corner_bytes(std::span<const Pair> pairs, const Input& input);

}  // namespace bvhbench
