// SPDX-License-Identifier: MIT
#include "collide/colliders.h"
#include "collide/relation.h"
#include "collide/sweep.h"

namespace bvhbench {
namespace {

class Brute final : public Collider {
public:
    explicit Brute(const ColliderOptions& options) : options_(options) {}

    ColliderCard card() const override { return {"brute", "Sweep and prune [Cohen1995]"}; }
    bool needs_tree() const override { return false; }
    std::string refusal(const Tree&) const override { return {}; }
    void reserve(const Tree*, const Input&) override {}
    Footprint reserved() const override { return {}; }

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        queue.on_host("broad", [&] {
            found_ = among_objects(
                touching_pairs(input.points, input.faces, options_.keep_adjacent), input.objects,
                options_.among);
        });
    }

    bool complete(const Queue&) override { return true; }
    QueryCounts counts(const Queue&) const override { return {found_.size(), {}, {}, {}}; }
    std::vector<Pair> pairs(const Queue&) const override
    {
        return {found_.pairs().begin(), found_.pairs().end()};
    }

private:
    ColliderOptions options_;
    PairList found_;
};

}  // namespace

std::unique_ptr<Collider> make_brute(Programs&, const ColliderOptions& options)
{
    return std::make_unique<Brute>(options);
}

}  // namespace bvhbench
