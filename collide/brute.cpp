// SPDX-License-Identifier: MIT
#include "collide/colliders.h"
#include "collide/relation.h"
#include "collide/sweep.h"

namespace bvhbench {
namespace {

class Brute final : public Collider {
public:
    explicit Brute(const ColliderOptions& options) : keep_adjacent_(options.keep_adjacent) {}

    ColliderCard card() const override { return {"brute", "Sweep and prune [Cohen1995]"}; }
    std::string refusal(const Tree&) const override { return {}; }
    void reserve(const Tree&) override {}
    Footprint reserved() const override { return {}; }

    void query(const Tree&, const Input& input, Queue& queue) override
    {
        queue.on_host("broad",
                      [&] { found_ = touching_pairs(input.points, input.faces, keep_adjacent_); });
    }

    bool complete(const Queue&) override { return true; }
    QueryCounts counts(const Queue&) const override { return {found_.size(), {}, {}}; }
    std::vector<Pair> pairs(const Queue&) const override
    {
        return {found_.pairs().begin(), found_.pairs().end()};
    }

private:
    bool keep_adjacent_;
    PairList found_;
};

}  // namespace

std::unique_ptr<Collider> make_brute(Programs&, const ColliderOptions& options)
{
    return std::make_unique<Brute>(options);
}

}  // namespace bvhbench
