// SPDX-License-Identifier: MIT
#include "baselines/baselines.h"
#include "baselines/radix/hierarchy.h"

namespace bvhbench {
namespace {

class Karras final : public RadixHierarchy {
public:
    explicit Karras(const RadixSetup& setup)
        : RadixHierarchy(setup)
        , topology_(setup.kernel("baselines/radix/karras.cl", "topology"))
        , boxes_(setup.kernel("baselines/radix/karras.cl", "boxes"))
    {}

    void plan(Arena& arena) override
    {
        nodes_ = take_nodes(arena);
        parents_ = arena.take<uint>(leaves_.inner() + leaves_.count, Use::scratch);
        arrivals_ = arena.take<uint>(leaves_.inner(), Use::scratch);
    }

    void build(Queue& queue) override
    {
        set_arguments(topology_, leaves_.codes, nodes_, parents_, leaves_.count);
        launch_(queue, topology_, leaves_.count - 1,
                leaves_.codes.bytes() + nodes_.bytes() + parents_.bytes());
        refit(queue);
    }

    /// Children are read and boxes written; they share their sectors.
    void refit(Queue& queue) override
    {
        set_arguments(boxes_, leaves_.boxes, leaves_.ids, nodes_, parents_, arrivals_,
                      leaves_.count);
        launch_(queue, boxes_, leaves_.count,
                leaves_.box_bytes() + parents_.bytes() + child_bytes() + nodes_.bytes());
    }

private:
    cl::Kernel topology_, boxes_;
    Buffer<uint> parents_;  ///< inner nodes, then leaves
};

}  // namespace

std::unique_ptr<Builder> make_karras(Programs& programs, const BuildOptions& options)
{
    return make_radix_builder<Karras>(
        programs, "karras", "Binary radix tree, topology and then boxes [Karras2012]", options);
}

}  // namespace bvhbench
