// SPDX-License-Identifier: MIT
#include <optional>

#include "collide/oracles/host_collider.h"
#include "plugins/methods.h"
#include "plugins/state.h"

namespace bvhbench::outside {
namespace {

class OutsideCollider final : public Collider {
public:
    OutsideCollider(const Offer& offer, bool refits, const Device& device,
                    const ColliderOptions& options, std::optional<double> distance)
        : offer_(offer)
        , refits_(refits)
        , name_(offer.method.name + (refits ? "-refit" : ""))
        , among_(options.among)
        , keeps_adjacent_(options.keep_adjacent)
        , distance_(distance)
        , device_(device)
        , state_(offer.library, offer.method, offer.limits)
    {
        if (distance && !offer.method.within)
            refuse("does not say that it finds pairs within a distance: it takes no 'within'");
    }

    ColliderCard card() const override { return {name_, offer_.library.name}; }
    bool needs_tree() const override { return false; }
    bool is_on_host() const override { return true; }
    bool finds_contacts() const override { return distance_ || offer_.method.finds_contacts; }
    std::string refusal(const Tree&) const override { return {}; }
    bool complete(const Queue&) override { return true; }

    void reserve(const Tree*, const Input& input) override
    {
        if (input.is_swept() && !offer_.method.steps)
            refuse("takes the triangles of one moment: it knows no swept boxes");
        if (input.is_wide() && offer_.method.finds_contacts)
            refuse("takes vertices in floats: it cannot tell what kept doubles touch");
        if (!keeps_adjacent_ && !offer_.method.steps)
            refuse("finds all pairs: it takes no 'adjacent'");
        if (!input.is_swept() && among_ != Among::all)
            refuse("finds pairs of all triangles: it takes no 'pairs_of'");
        state_.reset();
        found_.reset();
        count_.reset();
        send_frame(input);
        if (!refits_)
            return;
        Queue queue(device_);
        state_.run("build", queue);
    }

    Footprint reserved() const override { return {state_.bytes(), 0}; }

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        found_.reset();
        if (send_frame(input))
            count_.reset();
        queue.cl().finish();  // nothing else runs beside it
        if (offer_.method.builds)
            state_.run(refits_ ? "refit" : "build", queue);
        state_.run("query", queue, distance_);
    }

    QueryCounts counts(const Queue&) const override
    {
        QueryCounts counts;
        counts.pairs = count_ ? *count_ : found().size();
        counts.more = {{"round_trip_ns", static_cast<std::uint64_t>(state_.round_trip_ns())}};
        return counts;
    }

    std::vector<Pair> pairs(const Queue&) const override { return found(); }

    DevicePairs device_pairs(Queue& queue) override
    {
        const std::vector<Pair>& pairs = found();
        if (copied_.pairs.size() < std::max<std::size_t>(1, pairs.size())) {
            copied_ = {};  // frees the old buffers first
            copied_ = room_for_pairs(device_, pairs.size() + pairs.size() / 8 + 1);
        }
        queue.on_host("copy", [&] { copy_pairs(pairs, copied_, queue); });
        return copied_;
    }

private:
    [[noreturn]] void refuse(const std::string& why) const
    {
        throw BadUsage("the collider " + name_ + " comes from outside and " + why);
    }

    /// Gives it the frame or step. Of the two objects of a step, pairs are sought between both, not within.
    bool send_frame(const Input& input)
    {
        return state_.send_frame(
            input,
            {among_ == Among::between_objects ? input.objects.front().count : 0, !keeps_adjacent_});
    }

    /// Fetches the pairs of the last query, once.
    const std::vector<Pair>& found() const
    {
        if (!found_) {
            found_ = state_.pairs();
            count_ = found_->size();
        }
        return *found_;
    }

    Offer offer_;
    bool refits_;
    std::string name_;
    Among among_;
    bool keeps_adjacent_;
    std::optional<double> distance_;
    const Device& device_;
    mutable State state_;
    mutable std::optional<std::vector<Pair>> found_;
    /// Of the frame, as last fetched: to fetch millions of pairs after each sample would take longer than to find them.
    mutable std::optional<std::size_t> count_;
    DevicePairs copied_;
};

}  // namespace

std::unique_ptr<Collider> make_collider(const Offer& offer, bool refits, const Device& device,
                                        const ColliderOptions& options,
                                        std::optional<double> distance)
{
    return std::make_unique<OutsideCollider>(offer, refits, device, options, distance);
}

}  // namespace bvhbench::outside
