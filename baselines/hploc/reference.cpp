// SPDX-License-Identifier: MIT
//
// The oracle of `hploc`: joins the ranges of the radix tree one after the other, as clusters.h says, on one core. It shares the
// key and the leaf order with the kernels, and the splits with the oracle of radix trees.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "baselines/baselines.h"
#include "baselines/host/host_builder.h"
#include "baselines/hploc/clusters.h"
#include "baselines/radix/reference.h"

namespace bvhbench {
namespace {

using Clusters = std::vector<int>;  ///< nodes, in the order of their places

/// Returns the place that the cluster at `place` chooses.
std::size_t choice_of(const HostTree& tree, const Clusters& clusters, std::size_t place)
{
    const auto box_at = [&](std::size_t at) {
        return tree.nodes[static_cast<std::size_t>(clusters[at])].box;
    };
    uint least = NO_KEY;
    std::size_t choice = place;
    for (std::size_t other = 0; other < clusters.size(); ++other) {
        const std::size_t apart = std::max(place, other) - std::min(place, other);
        if (apart == 0 || apart > SEARCH_RADIUS)
            continue;
        const uint key = cluster_key(box_at(place), box_at(other), static_cast<uint>(place),
                                     static_cast<uint>(other));
        if (key < least) {
            least = key;
            choice = other;
        }
    }
    return choice;
}

/// Returns the list after one round, with the new nodes added to `tree`.
Clusters after_round(HostTree& tree, const Clusters& clusters)
{
    std::vector<std::size_t> choices;
    for (std::size_t place = 0; place < clusters.size(); ++place)
        choices.push_back(choice_of(tree, clusters, place));
    Clusters left;
    for (std::size_t place = 0; place < clusters.size(); ++place) {
        const std::size_t other = choices[place];
        if (choices[other] != place) {
            left.push_back(clusters[place]);
        } else if (place < other) {
            HostTree::Node node;
            node.child = {clusters[place], clusters[other]};
            node.box = merged(tree.nodes[static_cast<std::size_t>(clusters[place])].box,
                              tree.nodes[static_cast<std::size_t>(clusters[other])].box);
            left.push_back(static_cast<int>(tree.nodes.size()));
            tree.nodes.push_back(node);
        }
    }
    return left;
}

/// Returns the tree with the root first and all other nodes behind their parents.
HostTree in_order(const HostTree& tree, int root)
{
    HostTree ordered;
    std::vector<int> from{root};
    for (std::size_t k = 0; k < from.size(); ++k) {
        HostTree::Node node = tree.nodes[static_cast<std::size_t>(from[k])];
        if (node.primitive == HostTree::none)
            for (int& child : node.child)
                if (child != HostTree::none) {
                    from.push_back(child);
                    child = static_cast<int>(from.size() - 1);
                }
        ordered.nodes.push_back(node);
    }
    return ordered;
}

HostTree hploc_tree(const HostLeafOrder& leaves)
{
    HostTree tree;
    const std::vector<RadixRange> ranges = radix_ranges(leaves);
    std::vector<Clusters> of_range(ranges.size());
    for (std::size_t k = ranges.size(); k-- > 0;) {  // children come after their parent
        const RadixRange& range = ranges[k];
        Clusters& clusters = of_range[k];
        if (range.first == range.last) {
            clusters.push_back(static_cast<int>(tree.nodes.size()));
            HostTree::Node& leaf = tree.nodes.emplace_back();
            leaf.primitive = static_cast<int>(leaves.ids[range.first]);
            leaf.box = leaves.boxes[leaves.ids[range.first]];
            continue;
        }
        clusters = std::exchange(of_range[range.left], {});
        for (const int cluster : std::exchange(of_range[range.left + 1], {}))
            clusters.push_back(cluster);
        const std::size_t most = k == 0 ? 1 : RANGE_CLUSTERS;
        while (clusters.size() > most)
            clusters = after_round(tree, clusters);
    }
    return in_order(tree, of_range.front().front());
}

class HplocReference final : public OrderedHostBuilder {
public:
    explicit HplocReference(const BuildOptions& options)
        : OrderedHostBuilder("hploc-reference",
                             "Clusters of a radix tree's ranges, slowly on the host [Benthin2024]",
                             options)
    {}

private:
    void build_tree() override { tree_.plain = hploc_tree(leaves_); }
};

}  // namespace

std::unique_ptr<Builder> make_hploc_reference(Programs&, const BuildOptions& options)
{
    return std::make_unique<HplocReference>(options);
}

}  // namespace bvhbench
