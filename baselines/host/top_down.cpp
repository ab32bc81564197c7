// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>

#include "baselines/baselines.h"
#include "baselines/host/centres.h"
#include "baselines/host/host_builder.h"

namespace bvhbench {
namespace {

/// Partitions at least two ids so that those of the left child come first. Returns their number: at least one, and not all.
using Split = std::size_t (*)(std::span<uint> ids, std::span<const Aabb> boxes,
                              std::span<const Centre> centres);

/// Builds top-down with one triangle per leaf and a given function to split sets of triangles.
class TopDown final : public HostBuilder {
public:
    TopDown(std::string_view name, std::string_view method, Split split)
        : HostBuilder(name, method), split_(split)
    {}

private:
    Footprint footprint(std::size_t primitives) const override
    {
        return {(2 * primitives - 1) * sizeof(HostTree::Node),
                primitives * (sizeof(Aabb) + sizeof(uint) + sizeof(Centre))};
    }

    void reserve_own(std::size_t primitives) override
    {
        boxes_.resize(primitives);
        tree_.plain.nodes.resize(2 * primitives - 1);
        ids_.resize(primitives);
        centres_.resize(primitives);
    }

    void build_tree() override
    {
        std::iota(ids_.begin(), ids_.end(), 0u);
        std::transform(boxes_.begin(), boxes_.end(), centres_.begin(), centre_of);
        link_nodes();
        tree_.merge_boxes();
    }

    const Tree& tree() const override { return tree_; }

    /// A node still to be built, and the range of its ids.
    struct Task {
        std::size_t node;
        std::size_t first;
        std::size_t count;
    };

    /// Builds the topology with an explicit stack, since the depth of a tree that minimizes costs is unbounded.
    void link_nodes()
    {
        std::size_t used = 1;
        std::vector<Task> tasks{{0, 0, ids_.size()}};
        while (!tasks.empty()) {
            const Task task = tasks.back();
            tasks.pop_back();
            HostTree::Node& node = tree_.plain.nodes[task.node];
            node = {};
            if (task.count == 1) {
                node.primitive = static_cast<int>(ids_[task.first]);
                node.box = boxes_[ids_[task.first]];
                continue;
            }
            const std::size_t left =
                split_(std::span(ids_).subspan(task.first, task.count), boxes_, centres_);
            node.child = {static_cast<int>(used), static_cast<int>(used + 1)};
            tasks.push_back({used + 1, task.first + left, task.count - left});
            tasks.push_back({used, task.first, left});
            used += 2;
        }
    }

    Split split_;
    PlainTree tree_;
    std::vector<uint> ids_;
    std::vector<Centre> centres_;
};

/// Splits at the median along the longest axis of the centres.
std::size_t split_in_halves(std::span<uint> ids, std::span<const Aabb>,
                            std::span<const Centre> centres)
{
    split_at(ids, centres, ids.size() / 2);
    return ids.size() / 2;
}

/// Returns half the surface area of a box, in double because the products of large floats exceed a float.
double half_area(Aabb box)
{
    const double x = static_cast<double>(box.max_x) - box.min_x;
    const double y = static_cast<double>(box.max_y) - box.min_y;
    const double z = static_cast<double>(box.max_z) - box.min_z;
    return x * y + y * z + z * x;
}

constexpr std::size_t bin_count = 16;

/// Assigns a centre to one of `bin_count` equally wide bins between the bounds along an axis.
struct Binning {
    std::size_t axis;
    double low;
    double bins_a_unit;

    Binning(const CentreBounds& bounds, std::size_t along)
        : axis(along), low(bounds.low[along]), bins_a_unit(bin_count / bounds.extent(along))
    {}

    std::size_t operator()(const Centre& centre) const
    {
        return std::min(static_cast<std::size_t>((centre[axis] - low) * bins_a_unit),
                        bin_count - 1);
    }
};

struct Bin {
    Aabb box = empty_box();
    std::size_t count = 0;

    void add(const Bin& other)
    {
        box = merged(box, other.box);
        count += other.count;
    }
    double cost() const { return half_area(box) * static_cast<double>(count); }
};

/// A position to split at and its SAH cost: half area times number of triangles, summed over both children [Aila2013].
struct Cut {
    double cost;
    std::size_t axis = 3;     ///< 3: no cut
    std::size_t left_bins{};  ///< number of bins left of the cut
};

/// Replaces `best` by the cheapest cut along the binning's axis if that is cheaper.
void try_axis(const Binning& binning, std::span<const uint> ids, std::span<const Aabb> boxes,
              std::span<const Centre> centres, Cut& best)
{
    std::array<Bin, bin_count> bins;
    for (const uint id : ids)
        bins[binning(centres[id])].add({boxes[id], 1});

    std::array<Bin, bin_count> from_right = bins;  // each merged with all bins right of it
    for (std::size_t i = bin_count - 1; i-- > 0;)
        from_right[i].add(from_right[i + 1]);
    Bin left;
    for (std::size_t i = 1; i < bin_count; ++i) {
        left.add(bins[i - 1]);
        const double cost = left.cost() + from_right[i].cost();
        if (left.count > 0 && from_right[i].count > 0 && (best.axis == 3 || cost < best.cost))
            best = {cost, binning.axis, i};
    }
}

/// Splits at the cheapest cut between 16 bins on each axis, also for small sets. Along an axis of nonzero extent the first and
/// the last bin contain a centre each, so there is a cut unless all centres coincide. Then the ids are split into halves in
/// their current order.
std::size_t split_by_cost(std::span<uint> ids, std::span<const Aabb> boxes,
                          std::span<const Centre> centres)
{
    const CentreBounds bounds = centre_bounds(ids, centres);
    Cut best{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (bounds.extent(axis) > 0)
            try_axis(Binning(bounds, axis), ids, boxes, centres, best);
    if (best.axis == 3)
        return ids.size() / 2;
    const Binning binning(bounds, best.axis);
    const auto right = std::partition(
        ids.begin(), ids.end(), [&](uint id) { return binning(centres[id]) < best.left_bins; });
    return static_cast<std::size_t>(right - ids.begin());
}

}  // namespace

std::unique_ptr<Builder> make_median_split(Programs&, const BuildOptions&)
{
    return std::make_unique<TopDown>("median-split",
                                     "object median on the longest axis, on one core of the host",
                                     split_in_halves);
}

std::unique_ptr<Builder> make_sah_binned(Programs&, const BuildOptions&)
{
    return std::make_unique<TopDown>(
        "sah-binned", "binned surface area heuristic, 16 bins an axis, on one core of the host",
        split_by_cost);
}

}  // namespace bvhbench
