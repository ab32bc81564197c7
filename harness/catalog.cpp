// SPDX-License-Identifier: MIT
#include "harness/catalog.h"

#include "baselines/baselines.h"
#include "geometry/error.h"
#include "oibvh/oibvh.h"

namespace bvhbench {
namespace {

/// A builder whose tree no other makes: its promises decide alone.
constexpr BuilderEntry promised(std::string_view name, std::string_view summary, MakeBuilder make)
{
    return {name, summary, make, {}, {}};
}

constexpr BuilderEntry of_embree(std::string_view name, std::string_view summary, MakeBuilder make)
{
    return {name, summary,
            make, make != nullptr ? "" : "built without Embree",
            {},   "Embree takes no coordinates beyond 1.8e18"};
}

constexpr BuilderEntry of_fcl(std::string_view name, std::string_view summary, MakeBuilder make)
{
    return {name, summary, make, make != nullptr ? "" : "built without FCL", {}};
}

// To add a builder, add its line here. Nothing registers itself.
constexpr BuilderEntry catalog[] = {
    {"perfect", "perfect implicit tree, padded to a power of two leaves", make_perfect},
    {"oibvh-single", "Oi-BVH in one launch, groups meet through global atomics", make_oibvh_single},
    {"oibvh-multi", "Oi-BVH in several launches, groups meet between them", make_oibvh_multi},
    {"oibvh-reference", "Oi-BVH on one core of the host, slowly: the oracle", make_oibvh_reference},
    promised("heap-median", "left-balanced heap, split at medians, on a host core",
             make_heap_median),
    promised("median-split", "halves along the longest axis, on a host core", make_median_split),
    promised("sah-binned", "binned surface area heuristic, on a host core", make_sah_binned),
    of_embree("embree-low", "Embree's Morton builder, on all host threads", make_embree_low),
    of_embree("embree-medium", "Embree's binned SAH, on all host threads", make_embree_medium),
    of_embree("embree-high", "Embree's best without splitting triangles: as embree-medium",
              make_embree_high),
    of_fcl("fcl-aabb", "FCL's tree of axis-aligned boxes, on a host core", make_fcl_aabb),
    of_fcl("fcl-obbrss",
           "FCL's tree of oriented boxes, on a host core, shown with axis-aligned ones",
           make_fcl_obbrss),
};

}  // namespace

std::span<const BuilderEntry> builder_catalog() { return catalog; }

const BuilderEntry& find_builder(std::string_view name)
{
    std::string known;
    for (const BuilderEntry& entry : catalog) {
        if (entry.name == name)
            return entry;
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw BadUsage("no builder is called '" + std::string(name) + "'; there are: " + known);
}

std::unique_ptr<Builder> make_builder(const BuilderChoice& choice, Programs& programs)
{
    const BuilderEntry& entry = find_builder(choice.name);
    if (entry.make == nullptr)
        throw Unavailable(std::string(entry.absent));
    return entry.make(programs, choice.options());
}

}  // namespace bvhbench
