// SPDX-License-Identifier: MIT
#include "collide/oracles/host_collider.h"
#include "collide/oracles/sweep.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

class Brute final : public HostCollider {
public:
    Brute(const Device& device, const ColliderOptions& options)
        : HostCollider(device, {"brute", "Sweep and prune [Cohen1995]"}, options)
    {}

    void reserve(const Tree*, const Input&) override {}

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        queue.on_host("broad", [&] {
            const PairList found =
                touching_pairs(leaf_boxes(input), input.faces, options_.keep_adjacent,
                               input.objects, options_.among);
            require_host_memory("collider brute", found.size() * sizeof(Pair));
            found_.assign(found.pairs().begin(), found.pairs().end());
        });
    }
};

}  // namespace

std::unique_ptr<Collider> make_brute(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Brute>(programs.device(), options);
}

}  // namespace bvhbench
