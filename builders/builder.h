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

/// Who a builder is, for listings, result files and plot legends.
struct BuilderCard {
    std::string_view name;    ///< unique, stable, used on the command line and in result files
    std::string_view method;  ///< the publication or library, as cited in docs/references.md
    enum class Runs { on_host, on_device } runs;
};

/// How to build. One struct for all builders: what a builder has no use for it ignores.
struct BuildOptions {
    std::string_view order = "morton30";  ///< a name of order_catalog(): how leaves are lined up
    GridOver grid = GridOver::object;     ///< what codes are measured against, of several objects
    /// Work-items in a group, a power of two; 0 leaves the choice to the builder, by kind of device.
    unsigned group_size = 0;
    /// Nodes that a work-item merges in registers before its group shares them, a power of two; 0 as above.
    unsigned items = 0;
    /// Copy the leaf boxes into leaf order (one gather, coherent traversals) instead of leaving them in mesh
    /// order behind their sorted ids, as the paper does (Alg. 1, "mesh-order real-leaf array").
    bool sorted_leaves = false;
    /// A name of box_formats(): what the tree keeps its boxes in. All but f32 want sorted leaves. A builder that has no
    /// other than f32 refuses them.
    std::string_view boxes = "f32";
};

/// Where a build starts. Later starts reuse what the previous build on the same input left in place.
enum class Start {
    from_triangles,      ///< stages bounds, codes, sort, order and then hierarchy
    from_sorted_leaves,  ///< leaf boxes and sorted ids are given: the setting of the paper's Table 1
};

/// How a frame's tree comes from that of the frame before: all of it anew, new boxes for what stands, or not at all.
/// From what does most to what does nothing, so that of several the least brings all of them along.
enum class TreeUpdate { rebuild, refit, keep };

/// What brings along trees that want these if all must be treated alike.
inline TreeUpdate update_of_all(std::span<const TreeUpdate> wanted, bool can_refit)
{
    const TreeUpdate most = *std::min_element(wanted.begin(), wanted.end());
    return most == TreeUpdate::refit && !can_refit ? TreeUpdate::rebuild : most;
}

/// Builds a hierarchy over triangles. One instance serves one size until `reserve` is called again.
///
/// Stages are words from a fixed list: bounds, codes, sort, order, gather, hierarchy, refit.
class Builder {
public:
    virtual ~Builder() = default;

    virtual BuilderCard card() const = 0;

    /// Bytes for `primitives` triangles, known before there is one. Exactly what `reserve` will allocate.
    virtual Footprint footprint(std::size_t primitives) const = 0;

    /// Allocate everything for `primitives` triangles, 1 to 2^31. Never timed. Throws Unavailable.
    virtual void reserve(std::size_t primitives) = 0;

    /// The same for objects of so many triangles each, none of them empty: one build makes a tree of each. Throws
    /// Unavailable as well if it builds one tree only, and BadUsage for options that several objects do not allow.
    virtual void reserve_objects(std::span<const uint> sizes)
    {
        if (sizes.size() != 1)
            throw Unavailable(std::string(card().name) + " builds one tree at a time, not " +
                              std::to_string(sizes.size()));
        reserve(sizes.front());
    }

    /// What `reserve` took, counted as it was handed out, and what updates took since; zeros before.
    virtual Footprint reserved() const = 0;

    /// Enqueue or run one whole build, stage by stage. Allocates nothing and does not wait.
    /// The tree belongs to the builder and holds until the next `build` or `reserve`; reading it waits.
    virtual const Tree& build(const Input& input, Queue& queue,
                              Start start = Start::from_triangles) = 0;

    /// Whether `refit` may be called.
    virtual bool can_refit() const { return false; }

    /// Enqueue new boxes for the tree that stands, over the same faces with moved points: stages bounds, gather
    /// if leaves are sorted, and refit. Topology and ids stay. Allocates nothing and does not wait.
    virtual const Tree& refit(const Input&, Queue&)
    {
        throw Unavailable(std::string(card().name) + " cannot refit");
    }

    /// Plans the next updates: what each does for the tree of each object. Returns the plan, which may do more than
    /// `wanted` asks for where a builder cannot treat each object in its own way. Updates begin from the trees that stand now,
    /// however often they are repeated. Takes memory when first called, and writes down what updates read: never timed.
    /// Waits, and forgets the stages since the queue's last `finish`.
    virtual std::vector<TreeUpdate> plan_update(std::span<const TreeUpdate> wanted, Queue& queue);

    /// Enqueue one update as planned, over the same faces with moved points: the stages of a build, of what they are
    /// needed for; for all objects one set of launches. Allocates nothing and does not wait. Where all trees are kept,
    /// there is nothing to call it for.
    virtual const Tree& update(const Input& input, Queue& queue);

private:
    TreeUpdate update_ = TreeUpdate::rebuild;  ///< of builders that treat all objects alike
};

/// Makes a builder on the device that `programs` compiles for. Throws BadUsage for options it cannot keep.
using MakeBuilder = std::unique_ptr<Builder> (*)(Programs& programs, const BuildOptions& options);

}  // namespace bvhbench
