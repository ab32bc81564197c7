// SPDX-License-Identifier: MIT
#include "harness/mann_whitney.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bvhbench {
namespace {

constexpr std::size_t most_exact = 20;

/// U of `a`, and the sum of t^3 - t over runs of t equal values.
struct Ranked {
    double u;
    double ties;
};

Ranked ranked(const std::vector<double>& a, const std::vector<double>& b)
{
    struct Value {
        double value;
        bool is_a;
    };
    std::vector<Value> all;
    for (const double value : a)
        all.push_back({value, true});
    for (const double value : b)
        all.push_back({value, false});
    std::sort(all.begin(), all.end(),
              [](const Value& x, const Value& y) { return x.value < y.value; });
    double rank_sum = 0;
    double ties = 0;
    for (std::size_t first = 0; first < all.size();) {
        std::size_t end = first;
        while (end < all.size() && all[end].value == all[first].value)
            ++end;
        const double rank = static_cast<double>(first + 1 + end) / 2;  // of each of them, from 1
        for (std::size_t i = first; i < end; ++i)
            rank_sum += all[i].is_a ? rank : 0;
        const auto equal = static_cast<double>(end - first);
        ties += equal * equal * equal - equal;
        first = end;
    }
    const auto n = static_cast<double>(a.size());
    return {rank_sum - n * (n + 1) / 2, ties};
}

/// In how many of all orders of n and m values U is at most `u`, as a share of them.
double share_up_to(std::size_t n, std::size_t m, std::size_t u)
{
    // Coefficients of the Gaussian binomial: multiplied by 1 - q^(m + i), divided by 1 - q^i.
    std::vector<double> ways(n * m + 1);
    ways[0] = 1;
    for (std::size_t i = 1; i <= n; ++i) {
        for (std::size_t k = ways.size(); k-- > m + i;)
            ways[k] -= ways[k - (m + i)];
        for (std::size_t k = i; k < ways.size(); ++k)
            ways[k] += ways[k - i];
    }
    double below = 0;
    double all = 0;
    for (std::size_t k = 0; k < ways.size(); ++k) {
        all += ways[k];
        below += k <= u ? ways[k] : 0;
    }
    return below / all;
}

double exact_p(std::size_t n, std::size_t m, double u)
{
    const double smaller = std::min(u, static_cast<double>(n * m) - u);
    return std::min(1.0, 2 * share_up_to(n, m, static_cast<std::size_t>(smaller)));
}

double approximate_p(double n, double m, const Ranked& of)
{
    const double all = n + m;
    const double variance = n * m / 12 * (all + 1 - of.ties / (all * (all - 1)));
    const double distance = std::fabs(of.u - n * m / 2) - 0.5;  // continuity
    if (!(variance > 0) || distance <= 0)
        return 1;
    return std::erfc(distance / std::sqrt(2 * variance));
}

}  // namespace

MannWhitney mann_whitney(const std::vector<double>& a, const std::vector<double>& b)
{
    if (a.empty() || b.empty())
        return {};
    const Ranked of = ranked(a, b);
    const bool is_exact = of.ties == 0 && std::max(a.size(), b.size()) <= most_exact;
    return {of.u, is_exact ? exact_p(a.size(), b.size(), of.u)
                           : approximate_p(static_cast<double>(a.size()),
                                           static_cast<double>(b.size()), of)};
}

}  // namespace bvhbench
