// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "builders/input.h"
#include "builders/orders.h"
#include "builders/tree.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/error.h"

namespace bvhbench {

/// How a builder is named in listings, result files and plot legends.
struct BuilderCard {
    std::string_view name;    ///< Unique and stable; used on the command line and in result files.
    std::string_view method;  ///< Publication or library, as cited in docs/references.md.
    enum class Runs { on_host, on_device } runs;
};

/// Options of all builders. A builder ignores the options that do not apply to it.
struct BuildOptions {
    std::string order = "morton30";    ///< Order of the leaves: a name in order_catalog().
    GridOver grid = GridOver::object;  ///< Bounds that codes are computed in (several objects).
    /// Work-items per group, a power of two. 0: the builder chooses by kind of device.
    unsigned group_size = 0;
    /// Nodes that a work-item merges in registers before its group shares them, a power of two. 0: the builder chooses.
    unsigned items = 0;
    /// True: leaf boxes are copied into leaf order (one gather; coherent traversals). False: they stay in mesh order and are
    /// found through the sorted ids, as in the paper (Alg. 1, "mesh-order real-leaf array").
    bool sorted_leaves = false;
    /// Storage format of the tree's boxes: a name in box_formats(). Formats other than f32 require `sorted_leaves`; a builder
    /// that supports f32 only throws BadUsage for them.
    std::string boxes = "f32";

    bool operator==(const BuildOptions&) const = default;
};

/// Where a build starts. A later start reuses the results of the previous build on the same input.
enum class Start {
    from_triangles,  ///< All stages: bounds, codes, sort, order, gather and hierarchy.
    from_sorted_leaves,  ///< Only `hierarchy`, over existing leaf boxes and sorted ids: the setting of the paper's Table 1.
};

/// How a frame's tree is made from the previous frame's: full rebuild, new boxes on the same topology, or no change. Sorted
/// from most to least work, so the least value among several objects is sufficient for all of them.
enum class TreeUpdate { rebuild, refit, keep };

/// Returns the update that serves all of `wanted` if every tree must be updated in the same way.
inline TreeUpdate update_of_all(std::span<const TreeUpdate> wanted, bool can_refit)
{
    const TreeUpdate most = *std::min_element(wanted.begin(), wanted.end());
    return most == TreeUpdate::refit && !can_refit ? TreeUpdate::rebuild : most;
}

/// Builds a hierarchy over triangles. One instance serves the sizes of the last `reserve`.
///
/// Stage names come from a fixed list: bounds, codes, sort, order, gather, hierarchy, refit.
class Builder {
public:
    virtual ~Builder() = default;

    virtual BuilderCard card() const = 0;

    /// Returns the bytes that `reserve` will allocate for `primitives` triangles, exactly. Allocates nothing.
    virtual Footprint footprint(std::size_t primitives) const = 0;

    /// Allocates all memory for `primitives` triangles, 1 to 2^31. Never timed. Throws Unavailable.
    virtual void reserve(std::size_t primitives) = 0;

    /// Allocates all memory for objects of `sizes` triangles, each at least 1; one build then makes one tree per object. Throws
    /// Unavailable also if the builder supports one tree only, and BadUsage for options that exclude several objects.
    virtual void reserve_objects(std::span<const uint> sizes)
    {
        if (sizes.size() != 1)
            throw Unavailable(std::string(card().name) + " builds one tree at a time, not " +
                              std::to_string(sizes.size()));
        reserve(sizes.front());
    }

    /// Returns the bytes allocated by `reserve` and by later updates, counted at allocation; zeros before.
    virtual Footprint reserved() const = 0;

    /// Enqueues or runs one complete build, stage by stage. Allocates nothing and does not block. The builder owns the returned
    /// tree, which is valid until the next `build` or `reserve`; reading it blocks.
    virtual const Tree& build(const Input& input, Queue& queue,
                              Start start = Start::from_triangles) = 0;

    /// True if `refit` may be called.
    virtual bool can_refit() const { return false; }

    /// Enqueues new boxes for the current tree, over the same faces with moved points: stages bounds, gather (if leaves are
    /// sorted) and refit. Topology and ids do not change. Allocates nothing and does not block. Throws Unavailable if not
    /// can_refit().
    virtual const Tree& refit(const Input&, Queue&)
    {
        throw Unavailable(std::string(card().name) + " cannot refit");
    }

    /// Plans the next updates. Returns the update of each object's tree, which may do more than `wanted` asks for if the
    /// builder cannot treat objects separately. Every later update starts from the trees as they are now, however often it is
    /// repeated. Allocates memory at the first call and uploads what updates read: never timed. Blocks, and discards the stages
    /// recorded since the queue's last `finish`.
    virtual std::vector<TreeUpdate> plan_update(std::span<const TreeUpdate> wanted, Queue& queue);

    /// Enqueues one planned update over the same faces with moved points: the stages of a build as far as they are needed, with
    /// one set of launches for all objects. Allocates nothing and does not block. Must not be called if all trees are kept.
    virtual const Tree& update(const Input& input, Queue& queue);

private:
    TreeUpdate update_ = TreeUpdate::rebuild;  ///< For builders that treat all objects alike.
};

/// Creates a builder on the device of `programs`. Throws BadUsage for unsupported options.
using MakeBuilder = std::unique_ptr<Builder> (*)(Programs& programs, const BuildOptions& options);

}  // namespace bvhbench
