// SPDX-License-Identifier: MIT
//
// bvh (version 2): its default builder at two qualities, its refit, and its general traversal, which is given a test of boxes.
#include "host_method.h"
#include "tree_writer.h"

#include <bvh/v2/default_builder.h>
#include <bvh/v2/executor.h>
#include <bvh/v2/stack.h>
#include <bvh/v2/thread_pool.h>

namespace {

using Node = bvh::v2::Node<float, 3>;
using Vec = bvh::v2::Vec<float, 3>;
using BBox = bvh::v2::BBox<float, 3>;
using Builder = bvh::v2::DefaultBuilder<Node>;

template <Builder::Quality quality>
class BvhV2 : public adapter::HostMethod {
public:
    void prepare(const bvhbench_mesh& mesh) override
    {
        HostMethod::prepare(mesh);
        boxes_.resize(mesh.triangles);
        centres_.resize(mesh.triangles);
        stacks_.resize(adapter::thread_count());
    }

    bvhbench_tree tree() override
    {
        return writer_.written(0u, [this](uint32_t number) {
            const Node& node = bvh_.nodes[number];
            const BBox box = node.get_bbox();
            adapter::Spelled<uint32_t> spelled{
                {box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}, {}, {}};
            const auto first = static_cast<uint32_t>(node.index.first_id());
            if (node.is_leaf())
                for (uint32_t k = 0; k < node.index.prim_count(); ++k)
                    spelled.triangles.push_back(static_cast<uint32_t>(bvh_.prim_ids[first + k]));
            else
                spelled.children = {first, first + 1};
            return spelled;
        });
    }

protected:
    void make_tree() override
    {
        adapter::in_parallel(triangles(), [this](unsigned, uint32_t t) {
            boxes_[t] = of_library(boxes()[t]);
            centres_[t] = boxes_[t].get_center();
        });
        Builder::Config config;
        config.quality = quality;
        bvh_ = Builder::build(threads_, boxes_, centres_, config);
    }

    void refit_tree() override
    {
        bvh_.refit([this](Node& leaf) {
            BBox box = BBox::make_empty();
            for (uint32_t k = 0; k < leaf.index.prim_count(); ++k)
                box.extend(of_library(boxes()[bvh_.prim_ids[leaf.index.first_id() + k]]));
            leaf.set_bbox(box);
        });
    }

    // Triangles are taken in the order of the leaves, so that neighbours walk alike.
    void find_pairs() override
    {
        adapter::in_parallel(triangles(), [this](unsigned thread, uint32_t k) {
            const auto own = static_cast<uint32_t>(bvh_.prim_ids[k]);
            const adapter::Box box = boxes()[own];
            const auto meets = [&box](const Node& node) {
                const auto& at = node.bounds;  // least x, greatest x, least y, ...
                return at[0] <= box.high[0] && box.low[0] <= at[1] && at[2] <= box.high[1] &&
                       box.low[1] <= at[3] && at[4] <= box.high[2] && box.low[2] <= at[5];
            };
            bvh_.template traverse_top_down<false>(
                bvh_.get_root().index, stacks_[thread],
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t at = begin; at < end; ++at) {
                        const auto other = static_cast<uint32_t>(bvh_.prim_ids[at]);
                        if (own < other && adapter::overlap(box, boxes()[other]))
                            add(thread, own, other);
                    }
                    return false;
                },
                [&](const Node& left, const Node& right) {
                    return std::make_tuple(meets(left), meets(right), false);
                });
        });
    }

    uint64_t tree_bytes() const override
    {
        return bvh_.nodes.capacity() * sizeof(Node) +
               bvh_.prim_ids.capacity() * sizeof(std::size_t) + boxes_.size() * sizeof(BBox) +
               centres_.size() * sizeof(Vec);
    }

private:
    static BBox of_library(const adapter::Box& box)
    {
        return BBox(Vec(box.low[0], box.low[1], box.low[2]),
                    Vec(box.high[0], box.high[1], box.high[2]));
    }

    bvh::v2::ThreadPool threads_;
    std::vector<BBox> boxes_;
    std::vector<Vec> centres_;
    std::vector<bvh::v2::GrowingStack<Node::Index>> stacks_;
    bvh::v2::Bvh<Node> bvh_;
    adapter::TreeWriter writer_;
};

template <Builder::Quality quality>
bvhbench_method method(const char* name, const char* summary)
{
    return adapter::method<adapter::RefittedHostCollider<BvhV2<quality>>>(name, summary);
}

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {
        method<Builder::Quality::Low>("bvh-v2-low",
                                      "DefaultBuilder, low quality, all cores; traverse_top_down"),
        method<Builder::Quality::High>(
            "bvh-v2-high", "DefaultBuilder, high quality, all cores; traverse_top_down")};
    return adapter::plugin(host_abi, "bvh v2", LIBRARY_VERSION, "MIT", "host", methods);
}
