// SPDX-License-Identifier: MIT
//
// Tight-Inclusion, as a plug-in of bvhbench: single queries of continuous collision detection, on all cores of the host.
#include <tight_inclusion/ccd.hpp>

#include "host_method.h"

namespace {

constexpr double tolerance = 1e-6;       // the library's default, a length
constexpr long most_halvings = 1000000;  // as in the paper

class TightInclusion {
public:
    void load(const bvhbench_queries& queries)
    {
        queries_ = queries;
        times_.resize(queries.count);
    }

    void answer(bvhbench_stages& stages)
    {
        const auto start = std::chrono::steady_clock::now();
        adapter::in_parallel(
            static_cast<uint32_t>(queries_.count),
            [this](unsigned, uint32_t k) { times_[k] = time_of(k); }, 1);
        const std::chrono::nanoseconds passed = std::chrono::steady_clock::now() - start;
        adapter::add_stage(stages, "narrow", 0, static_cast<uint64_t>(passed.count()), false);
    }

    const double* times() const { return times_.data(); }

private:
    double time_of(uint32_t query) const
    {
        using Vector = ticcd::Vector3;
        const auto at = [&](int point) {
            return Vector(&queries_.points[24 * std::size_t{query} + 3 * point]);
        };
        const ticcd::Array3 alone(-1, -1, -1);  // no scene's errors
        double time = 2, reached = 0;
        const bool touch = (queries_.of_edges ? ticcd::edgeEdgeCCD : ticcd::vertexFaceCCD)(
            at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), alone, 0, time, tolerance, 1,
            most_halvings, reached, false, ticcd::CCDRootFindingMethod::BREADTH_FIRST_SEARCH);
        return touch ? time : 2;
    }

    bvhbench_queries queries_{};
    std::vector<double> times_;
};

TightInclusion& of(void* state) { return *static_cast<TightInclusion*>(state); }

constexpr bvhbench_method methods[] = {
    {.name = "tight-inclusion",
     .summary = "inclusion functions, to 1e-6, on all cores",
     .create = [](char*) -> void* { return new TightInclusion; },
     .error = [](void*) { return "there is not enough memory"; },
     .destroy = [](void* state) { delete &of(state); },
     .load_queries = [](void* state,
                        const bvhbench_queries* queries) { return of(state).load(*queries), 0; },
     .answer = [](void* state, bvhbench_stages* stages) { return of(state).answer(*stages), 0; },
     .times = [](void* state, const double** times) { return *times = of(state).times(), 0; }}};

constexpr bvhbench_plugin plugin = {
    BVHBENCH_PLUGIN_ABI, "Tight-Inclusion", LIBRARY_VERSION, "MIT", "host", 1, methods};

}  // namespace

extern "C" const bvhbench_plugin* bvhbench_plugin_entry(uint32_t abi)
{
    return abi == BVHBENCH_PLUGIN_ABI ? &plugin : nullptr;
}
