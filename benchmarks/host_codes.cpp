// SPDX-License-Identifier: MIT
#include "benchmarks/host.h"
#include "geometry/hilbert.h"
#include "oibvh/layout.h"

namespace bvhbench {
namespace {

constexpr uint leaves = 144046;
constexpr uint side = 32;

constexpr std::uint64_t sum_below(std::uint64_t count) { return count * (count - 1) / 2; }

/// Returns the sum of the slots of all nodes of a tree. Slots are 0, 1, 2, ...
std::uint64_t sum_of_slots()
{
    uint count = leaves;
    benchmark::DoNotOptimize(count);  // else the compiler may compute the sum
    const OiShape shape = oi_shape(count);
    std::uint64_t sum = 0;
    for (uint level = 0; level <= shape.leaf_level; ++level)
        for (uint k = 0; k < oi_real_on(shape, level); ++k)
            sum += oi_slot(shape, oi_first(level) + k);
    return sum;
}

/// Registers the sum of the codes of all cells of a cube at the origin. Both curves fill it first, with codes 0, 1, 2, ...
template <class Code>
void register_codes(const char* name, Outcome& outcome, Code code)
{
    constexpr uint cells = side * side * side;
    register_host(name, outcome, cells, sum_below(cells), [code] {
        std::uint64_t sum = 0;
        uint count = cells;
        benchmark::DoNotOptimize(count);  // else the sum is computed once, or by the compiler
        for (uint k = 0; k < count; ++k)
            sum += code(GridCell{k / side / side, k / side % side, k % side});
        return sum;
    });
}

}  // namespace

void register_host_codes(Outcome& outcome)
{
    constexpr uint nodes = oi_node_count(oi_shape(leaves));
    register_host("layout/slots", outcome, nodes, sum_below(nodes), sum_of_slots);
    register_codes("codes/morton30", outcome, [](GridCell cell) { return morton_30(cell); });
    register_codes("codes/morton63", outcome, [](GridCell cell) { return morton_63(cell); });
    register_codes("codes/hilbert30", outcome, [](GridCell cell) { return hilbert_30(cell); });
    register_codes("codes/hilbert63", outcome, [](GridCell cell) { return hilbert_63(cell); });
}

}  // namespace bvhbench
