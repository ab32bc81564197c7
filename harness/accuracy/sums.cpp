// SPDX-License-Identifier: MIT
//
// The axis sums: the surface area cost of a tree, added up in several ways, against long double.
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/accuracy/axis.h"
#include "harness/judge/check.h"
#include "harness/judge/metrics.h"

namespace bvhbench {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64,
              "the reference must be more precise than what is compared with it");

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
        for (std::optional<Real>& place : waiting_) {
            if (!place) {
                place = value;
                return;
            }
            value += *std::exchange(place, std::nullopt);
        }
        waiting_.emplace_back(value);
    }
    Real value() const
    {
        Real sum = 0;
        for (const std::optional<Real>& place : waiting_)
            sum += place.value_or(0);
        return sum;
    }

private:
    std::vector<std::optional<Real>> waiting_;
};

/// Returns the cost, computed in Real and added up by Sum.
template <class Real, template <class> class Sum>
long double cost_by(const HostTree& tree)
{
    Sum<Real> inner, leaf;
    for (const HostTree::Node& node : tree.nodes)
        (node.primitive != HostTree::none ? leaf : inner).add(surface_area<Real>(node.box));
    const NodeCosts costs;
    return (static_cast<Real>(costs.inner) * inner.value() +
            static_cast<Real>(costs.triangle) * leaf.value()) /
           surface_area<Real>(tree.nodes.front().box);
}

// Plain, pairwise and compensated sums, in float and in double. To add a method, add its line here.
constexpr SumMethod methods[] = {
    {"f32", cost_by<float, PlainSum>},
    {"f32-pairwise", cost_by<float, PairwiseSum>},
    {"f32-compensated", cost_by<float, CompensatedSum>},
    {"f64", cost_by<double, PlainSum>},
    {"f64-pairwise", cost_by<double, PairwiseSum>},
    {"f64-compensated", [](const HostTree& tree) -> long double { return area_sums(tree)->cost(); },
     true},
};

/// Bound on the relative error of the method in use: a few roundings of doubles for any number of nodes.
constexpr double most_of_ours = 1e-14;

void prepare(const SumMethod& method, const HostTree& tree, long double right, Queue& queue,
             Measurement& one)
{
    const long double cost = method.cost(tree);
    const double error = static_cast<double>(std::fabs((cost - right) / right));
    one.cell.counters["nodes_count"] = static_cast<double>(tree.nodes.size());
    one.cell.counters["sah_cost"] = static_cast<double>(cost);
    one.cell.counters["relative_error"] = error;
    judge(one.cell, "long double", method.is_ours,
          error <= most_of_ours ? "" : "off by more than a few roundings");
    one.once = [&queue, &method, &tree, cost] {
        queue.on_host("sum", [&] {
            if (method.cost(tree) != cost)
                throw Unavailable("another sum the second time");
        });
        return queue.finish();
    };
}

}  // namespace

std::span<const SumMethod> sum_methods() { return methods; }

long double cost_in_long_double(const HostTree& tree)
{
    return cost_by<long double, CompensatedSum>(tree);
}

void measure_sums(const AxisRun& run, const SceneFacts& scene, const Input& input)
{
    require_host_memory("a tree", check_bytes(input.triangle_count()));
    const HostTree tree = built_tree(run.session, {.name = "oibvh-multi"}, input).to_host_tree();
    const long double right = cost_in_long_double(tree);
    if (!(right > 0))
        throw Unavailable(scene.name + " has no surface area cost: its box has no area");
    std::vector<AxisMethod> methods;
    for (const SumMethod& method : sum_methods())
        methods.push_back({.name = std::string(method.name), .prepare = [&](Measurement& one) {
                               prepare(method, tree, right, run.session.queue(), one);
                           }});
    measure_methods(run, "sums", scene, methods);
}

}  // namespace bvhbench
