// SPDX-License-Identifier: MIT
#include "harness/collider_catalog.h"

#include "collide/colliders.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

// To add a collider, add its line here. Nothing registers itself.
constexpr ColliderEntry catalog[] = {
    {"leaf", "each leaf against the tree, without a stack: by arithmetic, or by ropes", make_leaf},
    {"bvtt", "pairs of nodes a level after the other, in queues between launches: the paper's",
     make_bvtt},
    {"group", "neighbouring leaves as one query with their common box, then leaf by leaf",
     make_group},
    {"brute", "sweep and prune on one core of the host, without the tree: the oracle", make_brute},
};

}  // namespace

std::span<const ColliderEntry> collider_catalog() { return catalog; }

const ColliderEntry& find_collider(std::string_view name)
{
    std::string known;
    for (const ColliderEntry& entry : catalog) {
        if (entry.name == name)
            return entry;
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw BadUsage("no collider is called '" + std::string(name) + "'; there are: " + known);
}

}  // namespace bvhbench
