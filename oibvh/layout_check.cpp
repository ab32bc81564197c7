// SPDX-License-Identifier: MIT
#include "oibvh/layout_check.h"

#include <cstdint>
#include <vector>

namespace bvhbench {
namespace {

/// One level, computed from the level below (a parent is real if one of its children is), without the bit counts of layout.h.
struct Level {
    std::uint64_t real = 0, all = 0, first = 0, first_slot = 0;
};

std::vector<Level> levels_over(std::uint64_t leaves)
{
    std::vector<Level> levels(1);
    levels[0].all = 1;
    while (levels.back().all < leaves) {
        Level next;
        next.all = 2 * levels.back().all;
        next.first = levels.back().first + levels.back().all;
        levels.push_back(next);
    }
    levels.back().real = leaves;
    for (std::size_t level = levels.size() - 1; level-- > 0;)
        levels[level].real = (levels[level + 1].real + 1) / 2;
    for (std::size_t level = 1; level < levels.size(); ++level)
        levels[level].first_slot = levels[level - 1].first_slot + levels[level - 1].real;
    return levels;
}

/// Keeps the first wrong claim.
class Claims {
public:
    explicit Claims(std::uint64_t leaves) : where_("t = " + std::to_string(leaves) + ": ") {}

    void equal(const char* what, std::uint64_t found, std::uint64_t expected)
    {
        if (wrong_.empty() && found != expected)
            wrong_ = where_ + what + " is " + std::to_string(found) + ", not " +
                     std::to_string(expected);
    }
    const std::string& wrong() const { return wrong_; }

private:
    std::string where_, wrong_;
};

void check_level(OiShape shape, uint level, const Level& wide, Claims& claims)
{
    claims.equal("the first node of a level", oi_first(level), wide.first);
    claims.equal("the real nodes of a level", oi_real_on(shape, level), wide.real);
    claims.equal("the virtual nodes of a level", oi_virtual_on(shape, level), wide.all - wide.real);
    claims.equal("the first slot of a level", oi_first_slot(shape, level), wide.first_slot);
    claims.equal("whether a level is full", oi_is_full(shape, level), wide.real == wide.all);
    for (const std::uint64_t position : {std::uint64_t{0}, wide.real / 3, wide.real - 1}) {
        const auto i = static_cast<uint>(wide.first + position);
        claims.equal("a node's level", oi_level(i), level);
        claims.equal("whether a node is real", oi_is_real(shape, i), true);
        claims.equal("a node's slot", oi_slot(shape, i), wide.first_slot + position);
    }
    if (wide.real < wide.all)
        for (const std::uint64_t position : {wide.real, wide.all - 1})
            claims.equal("whether a virtual node is real",
                         oi_is_real(shape, static_cast<uint>(wide.first + position)), false);
}

}  // namespace

std::string layout_violation(std::uint64_t leaves, OiShape shape)
{
    const std::vector<Level> levels = levels_over(leaves);
    Claims claims(leaves);
    claims.equal("the number of levels", shape.leaf_level + 1, levels.size());
    for (uint level = 0; level < levels.size() && claims.wrong().empty(); ++level)
        check_level(shape, level, levels[level], claims);
    const Level& last = levels.back();
    const std::uint64_t stored = last.first_slot + last.real;
    claims.equal("the number of nodes", oi_node_count(shape), stored);
    claims.equal("the number of nodes of the perfect tree", oi_perfect_node_count(shape),
                 2 * last.all - 1);
    claims.equal("the number of virtual nodes", oi_virtual_node_count(shape),
                 2 * last.all - 1 - stored);
    claims.equal("the last leaf's slot",
                 oi_slot(shape, static_cast<uint>(last.first + last.real - 1)), stored - 1);
    return claims.wrong();
}

std::string layout_violation(uint leaves) { return layout_violation(leaves, oi_shape(leaves)); }

}  // namespace bvhbench
