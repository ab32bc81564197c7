// SPDX-License-Identifier: MIT
#include <algorithm>

#include "baselines/baselines.h"
#include "baselines/hploc/clusters.h"
#include "baselines/parameters.h"
#include "baselines/radix/builder.h"
#include "builders/stages/codes.h"

namespace bvhbench {
namespace {

constexpr uint team_size = 32;  // TEAM_SIZE of team.clh

/// [Benthin2024]: a radix tree whose larger ranges are joined anew by surface area. Boxes of the nodes are compared as floats,
/// also if the tree stores them in another format, so that all formats have the same tree.
class Hploc final : public RadixBuilder {
public:
    Hploc(Programs& programs, const BuildOptions& options)
        : RadixBuilder(programs, "hploc",
                       "Clusters of a radix tree's ranges, in one launch [Benthin2024]", make_hploc,
                       options, hploc_group_size)
        , builds_floats_(format().number == BOX_F32)
        , boxes_(kernel("baselines/radix/karras.cl", "boxes"))
        , links_(kernel("baselines/hploc/links.cl", builds_floats_ ? "link_nodes" : "copy_links"))
    {
        tree_.root_is_stored = tree_.is_clustered = true;
        const Define words{"CODE_WORDS", code_words(leaf_order_.code_bits())};
        const Define sorted{"SORTED_LEAVES", tree_.sorted && builds_floats_ ? 1u : 0u};
        if (most_items_ != 0) {
            build_ = programs.kernel("baselines/hploc/build_chunks.cl", "build", {words, sorted});
            return;
        }
        const bool has_warps = programs.device().lets_groups_wait();
        group_size_ = has_warps ? std::max<std::size_t>(group_size_, team_size) : team_size;
        team_leaves_ = programs.device().tuned(hploc_leaves);
        const Define teams{"TEAMS", static_cast<uint>(group_size_) / team_size};
        build_ = programs.kernel("baselines/hploc/build_groups.cl", "build",
                                 {words, sorted, teams, {"TEAM_LEAVES", team_leaves_}},
                                 Optimise::on_gpus);
    }

private:
    void plan_nodes(Arena& arena) override
    {
        tree_.nodes = take_nodes(arena);
        tree_.root = arena.take<uint>(1, Use::tree);
        arrivals_ = arena.take<uint>(tree_.inner(), Use::scratch);
        clusters_ = arena.take<uint>(2 * std::size_t{tree_.leaves}, Use::scratch);
        if (!builds_floats_)
            built_ = arena.take<RadixNode>(tree_.inner(), Use::scratch);
    }

    void prepare_nodes(const cl::CommandQueue& queue) override
    {
        RadixBuilder::prepare_nodes(queue);
        tree_.root.upload(queue, std::vector<uint>{radix_child(0, tree_.leaves == 1)});
    }

    void build_nodes(Queue& queue) override
    {
        // Leaves of different objects differ above the kept bits of their codes, of 64.
        const std::size_t objects = tree_.objects.size();
        const uint kept = kept_code_bits(find_order(options_.order).code_bits, objects);
        const uint root_common = objects == 1 ? 0 : 64 - kept;
        if (builds_floats_)
            set_arguments(build_, tree_.codes, tree_.leaf_boxes, tree_.ids, tree_.nodes, clusters_,
                          arrivals_, tree_.root, tree_.device_objects, tree_.leaves, root_common);
        else
            set_arguments(build_, tree_.codes, leaf_order_.boxes(), tree_.ids, built_, clusters_,
                          arrivals_, tree_.root, tree_.device_objects, tree_.leaves, root_common);
        const uint items = team_leaves_ == 0
                               ? tree_.leaves - 1
                               : divided_up(tree_.leaves - 1, team_leaves_) * team_size;
        launch(
            queue, build_, items,
            tree_.codes.bytes() + tree_.leaves * sizeof(Aabb) + tree_.inner() * sizeof(RadixNode));
        if (!builds_floats_)
            refit_nodes(queue);
    }

    /// Lists parents first: no build needs them, so none writes them.
    void refit_nodes(Queue& queue) override
    {
        const Buffer<uint>& parents = clusters_;  // which a finished build no longer needs
        if (builds_floats_)
            set_arguments(links_, tree_.nodes, tree_.root, parents, tree_.leaves);
        else
            set_arguments(links_, built_, tree_.nodes, tree_.root, parents, tree_.leaves);
        launch(queue, links_, tree_.leaves - 1, child_bytes() + parents.bytes());
        set_arguments(boxes_, tree_.leaf_boxes, tree_.ids, tree_.nodes, parents, arrivals_,
                      tree_.leaves);
        launch(queue, boxes_, tree_.leaves,
               box_bytes() + parents.bytes() + child_bytes() + tree_.nodes.bytes());
    }

    bool builds_floats_;
    uint team_leaves_ = 0;  ///< TEAM_LEAVES of build_groups.cl; 0 in the form for few cores
    cl::Kernel build_, boxes_, links_;
    Buffer<uint> clusters_;    ///< see ranges.clh; in a refit, parents of all nodes
    Buffer<RadixNode> built_;  ///< nodes with boxes of floats, for trees of another format
};

}  // namespace

std::unique_ptr<Builder> make_hploc(Programs& programs, const BuildOptions& options)
{
    return std::make_unique<Hploc>(programs, options);
}

}  // namespace bvhbench
