// SPDX-License-Identifier: MIT
//
// The axis sums: the surface area cost of a tree, added up in several ways, against long double.
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/accuracy/axis.h"
#include "harness/judge/check.h"
#include "harness/judge/metrics.h"

namespace bvhbench {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64,
              "the reference must be more precise than what is held to it");

template <class Real>
class PlainSum {
public:
    void add(Real value) { sum_ += value; }
    Real value() const { return sum_; }

private:
    Real sum_ = 0;
};

/// Keeps a sum of 2^k values at place k until a second one is complete.
template <class Real>
class PairwiseSum {
public:
    void add(Real value)
    {
        std::size_t place = 0;
        for (; place < waiting_.size() && is_waiting_[place]; ++place) {
            value += waiting_[place];
            is_waiting_[place] = false;
        }
        if (place == waiting_.size()) {
            waiting_.push_back(0);
            is_waiting_.push_back(false);
        }
        waiting_[place] = value;
        is_waiting_[place] = true;
    }
    Real value() const
    {
        Real sum = 0;
        for (std::size_t place = 0; place < waiting_.size(); ++place)
            if (is_waiting_[place])
                sum += waiting_[place];
        return sum;
    }

private:
    std::vector<Real> waiting_;
    std::vector<char> is_waiting_;
};

template <class Real, class Sum>
Real cost_by(const HostTree& tree)
{
    Sum inner, leaf;
    for (const HostTree::Node& node : tree.nodes)
        (node.primitive != HostTree::none ? leaf : inner).add(surface_area<Real>(node.box));
    const NodeCosts costs;
    return (static_cast<Real>(costs.inner) * inner.value() +
            static_cast<Real>(costs.triangle) * leaf.value()) /
           surface_area<Real>(tree.nodes.front().box);
}

template <class Real, class Sum>
double cost_as_double(const HostTree& tree)
{
    return static_cast<double>(cost_by<Real, Sum>(tree));
}

// Plain, pairwise and compensated sums, in float and in double. To add a method, add its line here.
constexpr SumMethod catalog[] = {
    {"f32", cost_as_double<float, PlainSum<float>>},
    {"f32-pairwise", cost_as_double<float, PairwiseSum<float>>},
    {"f32-compensated", cost_as_double<float, CompensatedSum<float>>},
    {"f64", cost_as_double<double, PlainSum<double>>},
    {"f64-pairwise", cost_as_double<double, PairwiseSum<double>>},
    {"f64-compensated", [](const HostTree& tree) { return area_sums(tree)->cost(); }, true},
};

/// Bound on the relative error of the method in use: a few roundings of doubles for any number of nodes.
constexpr double most_of_ours = 1e-14;

void settle(const SumMethod& method, const HostTree& tree, long double right, Queue& queue,
            Subject& one)
{
    const double cost = method.cost(tree);
    const double error = static_cast<double>(std::fabs((cost - right) / right));
    one.cell.counters["nodes_count"] = static_cast<double>(tree.nodes.size());
    one.cell.counters["sah_cost"] = cost;
    one.cell.counters["relative_error"] = error;
    Check& check = one.cell.check;
    check.against = "long double";
    check.verdict = !method.is_ours         ? Check::Verdict::counted
                    : error <= most_of_ours ? Check::Verdict::agrees
                                            : Check::Verdict::differs;
    if (check.verdict == Check::Verdict::differs)
        check.detail = "off by more than a few roundings";
    one.once = [&queue, &method, &tree, cost] {
        queue.on_host("sum", [&] {
            if (method.cost(tree) != cost)
                throw Unavailable("another sum the second time");
        });
        return queue.finish();
    };
}

}  // namespace

std::span<const SumMethod> sum_methods() { return catalog; }

long double cost_in_long_double(const HostTree& tree)
{
    return cost_by<long double, CompensatedSum<long double>>(tree);
}

void measure_sums(const AxisRun& run, const SceneFacts& scene, const Input& input)
{
    require_host_memory("a tree", check_bytes(input.triangle_count()));
    const HostTree tree = built_tree(run.session, {.name = "oibvh-multi"}, input).spelled_out();
    const long double right = cost_in_long_double(tree);
    if (!(right > 0))
        throw Unavailable(scene.name + " has no surface area cost: its box has no area");
    std::vector<AxisMethod> methods;
    for (const SumMethod& method : sum_methods())
        methods.push_back({.name = std::string(method.name), .settle = [&](Subject& one) {
                               settle(method, tree, right, run.session.queue(), one);
                           }});
    measure_methods(run, "sums", scene, methods);
}

}  // namespace bvhbench
