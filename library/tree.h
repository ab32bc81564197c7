// SPDX-License-Identifier: MIT
//
// Implementation of Tree: a builder, its tree, and one collider per Among and answer, created by the first query that needs it.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "builders/builder.h"
#include "builders/implicit/tree.h"
#include "collide/collider.h"
#include "collide/narrow/narrow.h"
#include "collide/within/within.h"
#include "geometry/names.h"
#include "library/input.h"

namespace bvhbench::oibvh {

/// A factory of builders or colliders, with the name that options select it by.
template <class Make>
struct Named {
    std::string_view name;
    Make make;
};

/// Makes the builder that `options` ask for, or the default for the device. Throws BadUsage for an unknown builder or order.
std::unique_ptr<Builder> make_builder(Device::Impl& device, const Options& options);

/// Returns the collider called `asked`, or the default for the device if `asked` is empty. Throws BadUsage for another name.
const Named<MakeCollider>& collider_for(const bvhbench::Device& device, std::string_view asked);

/// Copies of two separately built trees, joined as the trees of two objects of one frame, so that colliders can query them.
/// The leaf ids of the second tree follow those of the first.
class JoinedTrees {
public:
    JoinedTrees(Device::Impl& device, MakeCollider make) : device_(device), make_(make) {}

    /// Finds the overlapping pairs of a leaf of `a` and a leaf of `b`, each numbered as in its own tree. Allocates if the
    /// trees' sizes differ from those of the last call. The returned collider holds the pairs until the next call. Waits.
    /// Throws BadUsage if a tree has several objects, if `sorted_leaves` differs, or for more than 2^31 leaves together.
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
    /// Leaves of `a`, leaves of `b`, and whether leaves are sorted: what memory is reserved for.
    std::tuple<uint, uint, bool> reserved_for_ = {};
};

/// A tree over padded boxes, and the narrow phase that decides which of its pairs are within a distance. The first build takes memory,
/// and one over another number of points.
class PaddedTree {
public:
    PaddedTree(Device::Impl& device, const Options& options) : device_(device), options_(options) {}

    /// Builds over triangles; `sizes` are those of the objects. Returns the padded input, for colliders. Throws BadUsage for a distance
    /// that is negative or not finite.
    bvhbench::Input build(double distance, const bvhbench::Input& input,
                          const std::vector<uint>& sizes);

    const ImplicitTree& tree() const { return *tree_; }  ///< The last build's.

    /// Decides which candidates are within the distance. Returns them, and their number. Waits.
    std::pair<DevicePairs, std::uint64_t> decide(const bvhbench::Input& input,
                                                 const DevicePairs& candidates);

    std::size_t memory() const;
    void free();  ///< Frees all memory.

private:
    Device::Impl& device_;
    const Options& options_;
    std::unique_ptr<Builder> builder_;
    std::optional<WithinPhase> phase_;
    std::size_t points_ = 0;  ///< that memory is reserved for
    const ImplicitTree* tree_ = nullptr;
};

struct Tree::Impl {
    Impl(const std::shared_ptr<Device::Impl>& on, Options asked);

    /// Begins a call that enqueues: discards recorded stages and orders the call behind everything enqueued before.
    void begin();

    /// Runs `make`, which refits or updates the current tree, on input of the same sizes. If it throws, there is no tree.
    void renew(const Input& input, const std::function<void(const bvhbench::Input&)>& make);

    /// Returns the current tree. Throws BadUsage, whose message begins with `what`, if there is none.
    const ImplicitTree& standing(const char* what) const;

    /// Runs a query, for pairs or up to the first contact: of the current tree or, with a distance, of one over padded boxes.
    /// `then` enqueues what follows the query, before it is waited for; its work is done anew with the query if that was not complete.
    Collider& queried(Among among, ObjectFilter filter, bool first,
                      std::optional<double> distance = {},
                      const std::function<void(Collider&)>& then = {});

    /// Throws BadUsage, naming `answers`, unless the tree is over triangles.
    void require_triangles(const char* answers) const;

    /// Returns the pairs of a query, and remembers them for `read_pairs`.
    Pairs found(DevicePairs pairs, std::uint64_t count);
    Pairs found_by(Collider& collider);

    std::shared_ptr<Device::Impl> device;  ///< declared first, so that it is destroyed last
    Options options;
    InputTaker taker;
    std::unique_ptr<Builder> builder;
    const Named<MakeCollider>& collider;
    std::vector<uint> sizes;  ///< leaves of each object that memory is reserved for; empty if none
    const ImplicitTree* tree = nullptr;  ///< null if there is no valid tree

    struct Query {
        std::unique_ptr<Collider> collider;  ///< null until the first query
        bool is_ready = false;               ///< whether the collider's memory is reserved
        ObjectFilter filter = {};            ///< of the collider
    };
    std::array<Query, 6> queries;  ///< by Among, for pairs, then up to the first contact
    JoinedTrees joined;
    PaddedTree padded;
    std::optional<NarrowPhase> narrow;  ///< of contacts
    /// The last query's pairs, and their number.
    std::optional<std::pair<DevicePairs, std::uint64_t>> last_pairs;
};

}  // namespace bvhbench::oibvh
