// SPDX-License-Identifier: MIT
#include "plugins/methods.h"
#include "plugins/state.h"

namespace bvhbench::outside {
namespace {

/// A tree in another process.
class OutsideTree final : public Tree {
public:
    explicit OutsideTree(State& state) : state_(state) {}

    std::size_t node_count() const override { return state_.tree().nodes.size(); }
    HostTree to_host_tree() const override { return state_.tree(); }

private:
    State& state_;
};

class OutsideBuilder final : public Builder {
public:
    explicit OutsideBuilder(const Offer& offer)
        : offer_(offer), state_(offer.library, offer.method, offer.limits)
    {}

    BuilderCard card() const override
    {
        const bool is_on_host = offer_.library.device == "host";
        return {offer_.method.name, offer_.library.name,
                is_on_host ? BuilderCard::Runs::on_host : BuilderCard::Runs::on_device};
    }

    /// Nothing is known before the process has the mesh.
    Footprint footprint(std::size_t) const override { return reserved(); }
    void reserve(std::size_t) override { state_.reset(); }
    Footprint reserved() const override { return {state_.bytes(), 0}; }

    const Tree& build(const Input& input, Queue& queue, Start start) override
    {
        if (start != Start::from_triangles)
            throw BadUsage("a builder from outside starts from triangles, and " +
                           offer_.method.name + " is to start from sorted leaves");
        return run("build", input, queue);
    }

    bool can_refit() const override { return offer_.method.refits; }

    const Tree& refit(const Input& input, Queue& queue) override
    {
        return can_refit() ? run("refit", input, queue) : Builder::refit(input, queue);
    }

private:
    const Tree& run(std::string_view call, const Input& input, Queue& queue)
    {
        if (input.is_swept())
            throw BadUsage("a builder from outside takes the triangles of one moment: " +
                           offer_.method.name + " knows no swept boxes");
        state_.send_frame(input);
        queue.cl().finish();  // nothing else runs beside it
        state_.run(call, queue);
        return tree_;
    }

    Offer offer_;
    mutable State state_;
    OutsideTree tree_{state_};
};

}  // namespace

std::unique_ptr<Builder> make_builder(const Offer& offer)
{
    return std::make_unique<OutsideBuilder>(offer);
}

}  // namespace bvhbench::outside
