// SPDX-License-Identifier: MIT
#include "harness/choice/collider_catalog.h"

#include "baselines/baselines.h"
#include "collide/collider.h"
#include "collide/narrow/narrow_methods.h"
#include "geometry/error.h"
#include "harness/base/json_keys.h"

namespace bvhbench {
namespace {

// Host memory of the libraries per triangle. Embree: 24 bytes for the box, and 104 measured as the growth of the process beyond
// that of `brute` from torus:60000 to torus:160000. FCL, from its structures: two nodes of 64 bytes, a triangle of three 64-bit
// indices, half a vertex of 24 bytes now and in the previous frame, and a 4-byte index.
constexpr std::size_t embree_bytes = 128;
constexpr std::size_t fcl_bytes = 180;

constexpr ColliderEntry without_tree(std::string_view name, std::string_view summary,
                                     MakeCollider make)
{
    return {.name = name, .summary = summary, .make = make, .needs_tree = false};
}

constexpr ColliderEntry of_fcl(std::string_view name, std::string_view summary, MakeCollider make)
{
    return {name, summary, make, fcl_absent, fcl_bytes, true, false, true};
}

// To add a collider, add its line here. There is no other registration.
constexpr ColliderEntry catalog[] = {
    {"leaf", "each leaf against the tree, without a stack: by arithmetic, or by ropes", make_leaf},
    {"bvtt", "pairs of nodes a level after the other, in queues between launches: the paper's",
     make_bvtt},
    {"group", "neighbouring leaves as one query with their common box, then leaf by leaf",
     make_group},
    {"block", "blocks of neighbouring leaves against blocks, then their leaves: implicit trees",
     make_block},
    {"front", "where the frame before stopped, moved to where this one does, over refitted boxes",
     make_front},
    without_tree("grid", "no tree: boxes hashed by the cells they cover, on levels by their size",
                 make_grid),
    without_tree("brute", "sweep and prune on one core of the host, without the tree: the oracle",
                 make_brute),
    {"embree", "Embree's rtcCollide over trees of its own, on all host threads",
     make_embree_collider, embree_absent, embree_bytes, true, false},
    of_fcl("fcl", "triangles that intersect, by FCL, its trees built each time, on a host core",
           make_fcl_collider),
    of_fcl("fcl-refit", "the same, its trees refit to moved points", make_fcl_refit_collider),
};

}  // namespace

std::span<const ColliderEntry> collider_catalog() { return catalog; }

const ColliderEntry& find_collider(std::string_view name)
{
    return find_called(collider_catalog(), name, "collider");
}

std::unique_ptr<Collider> make_collider(const ColliderChoice& choice, Programs& programs)
{
    check_narrow(choice.narrow, choice.keep_adjacent);
    return make_collider(choice.name, programs, choice.options());
}

std::unique_ptr<Collider> make_collider(std::string_view name, Programs& programs,
                                        const ColliderOptions& options)
{
    const ColliderEntry& entry = find_collider(name);
    if (entry.make == nullptr)
        throw Unavailable(std::string(entry.absent));
    return entry.make(programs, options);
}

}  // namespace bvhbench
