// SPDX-License-Identifier: MIT
#include "baselines/baselines.h"
#include "baselines/radix/builder.h"

namespace bvhbench {
namespace {

class Karras final : public RadixBuilder {
public:
    Karras(Programs& programs, const BuildOptions& options)
        : RadixBuilder(programs, "karras",
                       "Binary radix tree, topology and then boxes [Karras2012]", make_karras,
                       options)
        , topology_(kernel("baselines/radix/karras.cl", "topology"))
        , boxes_(kernel("baselines/radix/karras.cl", "boxes"))
    {}

private:
    void plan_nodes(Arena& arena) override
    {
        tree_.nodes = take_nodes(arena);
        parents_ = arena.take<uint>(tree_.inner() + tree_.leaves, Use::scratch);
        arrivals_ = arena.take<uint>(tree_.inner(), Use::scratch);
    }

    void build_nodes(Queue& queue) override
    {
        set_arguments(topology_, tree_.codes, tree_.nodes, parents_, tree_.leaves);
        launch(queue, topology_, tree_.leaves - 1,
               tree_.codes.bytes() + tree_.nodes.bytes() + parents_.bytes());
        refit_nodes(queue);
    }

    void refit_nodes(Queue& queue) override
    {
        set_arguments(boxes_, tree_.leaf_boxes, tree_.ids, tree_.nodes, parents_, arrivals_,
                      tree_.leaves);
        launch(queue, boxes_, tree_.leaves,
               box_bytes() + parents_.bytes() + child_bytes() + tree_.nodes.bytes());
    }

    cl::Kernel topology_, boxes_;
    Buffer<uint> parents_;  ///< of the inner nodes, then of the leaves
};

}  // namespace

std::unique_ptr<Builder> make_karras(Programs& programs, const BuildOptions& options)
{
    return std::make_unique<Karras>(programs, options);
}

}  // namespace bvhbench
