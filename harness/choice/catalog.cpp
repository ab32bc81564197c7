// SPDX-License-Identifier: MIT
#include "harness/choice/catalog.h"

#include <ranges>
#include <vector>

#include "baselines/baselines.h"
#include "geometry/names.h"
#include "oibvh/oibvh.h"

namespace bvhbench {
namespace {

// Oracles. Apart from padding and pointers, all implicit trees are equal, and so are all radix trees.
constexpr std::string_view oi_tree = "oibvh-reference";
constexpr std::string_view radix_tree = "radix-reference";
constexpr std::string_view hploc_tree = "hploc-reference";
constexpr std::string_view own_tree = {};  // no other builder makes it: only invariants are checked

constexpr BuilderEntry in_own_order(std::string_view name, std::string_view summary,
                                    MakeBuilder make, std::string_view absent = {},
                                    std::string_view may_refuse = {}, bool is_library = false)
{
    return {name, summary, own_tree, make, absent, may_refuse, is_library, false, true};
}

constexpr BuilderEntry of_embree(std::string_view name, std::string_view summary, MakeBuilder make)
{
    return in_own_order(name, summary, make, embree_absent,
                        "Embree takes no coordinates beyond 1.8e18", true);
}

constexpr BuilderEntry in_any_format(std::string_view name, std::string_view summary,
                                     std::string_view tree, MakeBuilder make)
{
    return {name, summary, tree, make, {}, {}, false, true};
}

// To add a builder, add its line here. There is no other registration.
constexpr BuilderEntry own_builders[] = {
    in_any_format("perfect", "perfect implicit tree, padded to a power of two leaves", oi_tree,
                  make_perfect),
    in_any_format("karras", "LBVH [Karras2012]: topology of all nodes at once, then boxes",
                  radix_tree, make_karras),
    in_any_format("apetrei", "LBVH [Apetrei2014] as printed: ranges and counters in memory",
                  radix_tree, make_apetrei),
    in_any_format("apetrei-fused", "LBVH, topology and boxes in one launch, one exchange a node",
                  radix_tree, make_apetrei_fused),
    in_any_format("lbvh-levels",
                  "LBVH [Lauterbach2009] by levels: topology from the root down, boxes back up",
                  radix_tree, make_lbvh_levels),
    in_any_format("hploc",
                  "LBVH, its ranges joined anew by surface area [Benthin2024], in a launch",
                  hploc_tree, make_hploc),
    in_any_format("oibvh-single", "Oi-BVH in one launch, whole groups go on above others' subtrees",
                  oi_tree, make_oibvh_single),
    in_any_format("oibvh-single-printed",
                  "Oi-BVH in one launch as [Chitalu2020] prints it, by global atomics", oi_tree,
                  make_oibvh_single_printed),
    in_any_format("oibvh-multi", "Oi-BVH in several launches, groups meet between them", oi_tree,
                  make_oibvh_multi),
    in_any_format("oibvh-multi-printed",
                  "Oi-BVH in several launches as [Chitalu2020] prints it, by local atomics",
                  oi_tree, make_oibvh_multi_printed),
    {"oibvh-wide4", "Oi-BVH with 4 children a node, their boxes side by side", own_tree,
     make_oibvh_wide4},
    {"oibvh-wide8", "Oi-BVH with 8 children a node, their boxes side by side", own_tree,
     make_oibvh_wide8},
    in_any_format("oibvh-host",
                  "Oi-BVH by plain threads on the host, from leaves lined up on the device",
                  oi_tree, make_oibvh_host),
    {"oibvh-reference", "Oi-BVH on one core of the host, slowly: the oracle", oi_tree,
     make_oibvh_reference},
    {"radix-reference", "LBVH on one core of the host, slowly: the oracle", radix_tree,
     make_radix_reference},
    {"hploc-reference", "the tree of hploc on one core of the host, slowly: the oracle", hploc_tree,
     make_hploc_reference},
    in_own_order("heap-median", "left-balanced heap, split at medians, on a host core",
                 make_heap_median),
    in_own_order("median-split", "halves along the longest axis, on a host core",
                 make_median_split),
    in_own_order("sah-binned", "binned surface area heuristic, on a host core", make_sah_binned),
    of_embree("embree-low", "Embree's Morton builder, on all host threads", make_embree_low),
    of_embree("embree-medium", "Embree's binned SAH, on all host threads", make_embree_medium),
    of_embree("embree-high", "Embree's best without splitting triangles: as embree-medium",
              make_embree_high),
    in_own_order("fcl-aabb", "FCL's tree of axis-aligned boxes, on a host core", make_fcl_aabb,
                 fcl_absent, "", true),
    in_own_order("fcl-obbrss",
                 "FCL's tree of oriented boxes, on a host core, shown with axis-aligned ones",
                 make_fcl_obbrss, fcl_absent, "", true),
};

// Host memory of the libraries per triangle. Embree: 24 bytes for the box, and 104 measured as the growth of the process beyond
// that of `brute` from torus:60000 to torus:160000. FCL, from its structures: two nodes of 36 bytes, a triangle of three 64-bit
// indices, half a vertex of 12 bytes, and a 4-byte index.
constexpr std::size_t embree_bytes = 128;
constexpr std::size_t fcl_bytes = 106;

constexpr ColliderEntry filtering(std::string_view name, std::string_view summary,
                                  MakeCollider make, bool needs_tree = true)
{
    return {
        .name = name, .summary = summary, .make = make, .needs_tree = needs_tree, .filters = true};
}

// To add a collider, add its line here. There is no other registration.
constexpr ColliderEntry own_colliders[] = {
    {.name = "leaf",
     .summary = "each leaf against the tree, without a stack: by arithmetic, or by ropes",
     .make = make_leaf,
     .filters = true,
     .ends_early = true},
    filtering("bvtt",
              "pairs of nodes a level after the other, in queues between launches: the paper's",
              make_bvtt),
    filtering("group", "neighbouring leaves as one query with their common box, then leaf by leaf",
              make_group),
    filtering("block",
              "blocks of neighbouring leaves against blocks, then their leaves: binary trees",
              make_block),
    {.name = "front",
     .summary = "where the frame before stopped, moved to where this one does, over refitted boxes",
     .make = make_front,
     .refits = true},
    {.name = "front-leaf",
     .summary = "as front, for each leaf where its walk over the tree stopped",
     .make = make_leaf_front,
     .refits = true},
    {.name = "grid",
     .summary = "no tree: boxes hashed by the cells they cover, on levels by their size",
     .make = make_grid,
     .needs_tree = false},
    {.name = "all-pairs",
     .summary = "no tree: each box of an object against each, tile by tile",
     .make = make_all_pairs,
     .needs_tree = false},
    {.name = "sort-sweep",
     .summary = "no tree: boxes sorted along an axis of their object, and swept over",
     .make = make_sort_sweep,
     .needs_tree = false},
    filtering("brute", "sweep and prune on one core of the host, without the tree: the oracle",
              make_brute, false),
    {"embree", "Embree's rtcCollide over trees of its own, on all host threads",
     make_embree_collider, embree_absent, embree_bytes, true, false},
    {"embree-refit", "the same, its trees refit to moved points", make_embree_refit_collider,
     embree_absent, embree_bytes, true, false, false, nullptr, true},
    {"fcl", "triangles that intersect, by FCL, its trees built each time, on all host cores",
     make_fcl_collider, fcl_absent, fcl_bytes, true, false, true},
    {"fcl-refit", "the same, its trees refit to moved points", make_fcl_refit_collider, fcl_absent,
     fcl_bytes, true, false, true, nullptr, true},
};

/// What plug-ins add. It is filled once, before the catalogs are used.
struct Outside {
    std::vector<BuilderEntry> builders{std::begin(own_builders), std::end(own_builders)};
    std::vector<ColliderEntry> colliders{std::begin(own_colliders), std::end(own_colliders)};
    // Lists, so that the entries' texts keep their addresses.
    std::list<outside::Library> libraries;
    std::list<outside::Offer> offers;
    std::list<std::string> names;
    std::string broken;  ///< why plug-ins do not start; empty: all do
    std::list<BuilderEntry> broken_builders;
    std::list<ColliderEntry> broken_colliders;
};

Outside& outside_entries()
{
    static Outside entries;
    return entries;
}

/// Returns the entry called `name`. If there is none and a plug-in does not start, adds one to `broken`.
template <class Entries, class Entry>
const Entry& find_or_broken(const Entries& entries, std::list<Entry>& broken, std::string_view name,
                            const char* kind)
{
    Outside& all = outside_entries();
    if (all.broken.empty() || find_name(entries, name) != nullptr)
        return find_called(entries, name, kind);
    if (const Entry* found = find_name(broken, name))
        return *found;
    Entry& entry = broken.emplace_back();
    entry.name = all.names.emplace_back(name);
    entry.absent =
        all.names.emplace_back("no " + std::string(kind) + " is called '" + std::string(name) +
                               "', and a plug-in does not start: " + all.broken);
    entry.summary = entry.absent;
    entry.is_broken = true;
    return entry;
}

void require_free(std::string_view name, const std::string& file)
{
    const Outside& all = outside_entries();
    if (find_name(all.builders, name) == nullptr && find_name(all.colliders, name) == nullptr)
        return;
    throw BadUsage(file + " has a method '" + std::string(name) +
                   "', and there is a builder or collider of that name");
}

/// Throws BadUsage if the collider cannot leave out pairs of objects as it is asked to.
void check_filter(const ColliderChoice& choice, const ColliderEntry& entry)
{
    if (choice.filter.is_empty())
        return;
    if (!entry.filters)
        throw BadUsage(
            "the collider " + choice.name +
            " finds pairs of all objects; these leave out what 'exclude' names: " +
            joined(names_of(collider_catalog() | std::views::filter(&ColliderEntry::filters))));
    if (entry.needs_tree && (choice.rules_off & skip_apart) != 0)
        throw BadUsage(
            "'exclude' is applied where the rule 'apart' is, which therefore cannot be switched "
            "off");
}

}  // namespace

void add_outside(outside::Library library, const outside::Limits& limits)
{
    Outside& all = outside_entries();
    for (const outside::Method& method : library.methods) {
        require_free(method.name, library.file);
        if (method.refits && method.queries)
            require_free(method.name + "-refit", library.file);
    }
    const outside::Library& kept = all.libraries.emplace_back(std::move(library));
    for (const outside::Method& method : kept.methods) {
        const outside::Offer* offer =
            &all.offers.emplace_back(outside::Offer{kept, method, limits});
        const std::string& summary = all.names.emplace_back(
            method.summary + " (from outside: " + kept.name + ' ' + kept.version + ", " +
            kept.licence + ", on " + kept.device + ')');
        if (method.is_builder())
            all.builders.push_back({.name = method.name,
                                    .summary = summary,
                                    .oracle = own_tree,
                                    .make = nullptr,
                                    .is_library = true,
                                    .own_order = true,
                                    .outside = offer});
        const auto add_collider = [&](std::string_view name, std::string_view what, bool refits) {
            all.colliders.push_back({.name = name,
                                     .summary = what,
                                     .make = nullptr,
                                     .is_library = true,
                                     .needs_tree = false,
                                     .finds_contacts = method.finds_contacts,
                                     .outside = offer,
                                     .refits = refits});
        };
        if (method.queries)
            add_collider(method.name, summary, false);
        if (method.queries && method.refits)
            add_collider(all.names.emplace_back(method.name + "-refit"),
                         all.names.emplace_back(summary + ", its tree refit to moved points"),
                         true);
    }
}

void add_broken_outside(const std::string& why)
{
    std::string& broken = outside_entries().broken;
    broken += (broken.empty() ? "" : "; ") + why;
}

bool has_broken_outside() { return !outside_entries().broken.empty(); }

bool has_outside() { return !outside_entries().libraries.empty(); }

const std::list<outside::Offer>& outside_offers() { return outside_entries().offers; }

const outside::Library* outside_library(std::string_view name)
{
    for (const outside::Offer& offer : outside_entries().offers)
        if (name == offer.method.name || name == offer.method.name + "-refit")
            return &offer.library;
    return nullptr;
}

std::span<const BuilderEntry> builder_catalog() { return outside_entries().builders; }

const BuilderEntry& find_builder(std::string_view name)
{
    return find_or_broken(builder_catalog(), outside_entries().broken_builders, name, "builder");
}

void check_boxes(const BuilderChoice& choice)
{
    if (find_box_format(choice.boxes).number == BOX_F32)
        return;
    if (!find_builder(choice.name).takes_formats)
        throw BadUsage(
            choice.name + " keeps its boxes in its own way, not as " + choice.boxes +
            "; these do as they are told: " +
            joined(names_of(builder_catalog() | std::views::filter(&BuilderEntry::takes_formats))));
    if (!choice.sorted_leaves)
        throw BadUsage("boxes of " + choice.boxes +
                       " are made where leaves are lined up, so leaves must be sorted, not left in "
                       "mesh order");
}

std::unique_ptr<Builder> make_builder(const BuilderChoice& choice, Programs& programs)
{
    const BuilderEntry& entry = find_builder(choice.name);
    check_boxes(choice);
    if (entry.outside != nullptr)
        return outside::make_builder(*entry.outside);
    if (entry.make == nullptr)
        throw Unavailable(std::string(entry.absent));
    return entry.make(programs, choice);
}

std::span<const ColliderEntry> collider_catalog() { return outside_entries().colliders; }

const ColliderEntry& find_collider(std::string_view name)
{
    return find_or_broken(collider_catalog(), outside_entries().broken_colliders, name, "collider");
}

bool widens_boxes(const BuilderChoice& builder, const ColliderChoice& collider)
{
    const outside::Offer* const offer = find_collider(collider.name).outside;
    return offer ? offer->method.widens : find_box_format(builder.boxes).has_cells();
}

std::unique_ptr<Collider> make_collider(const ColliderChoice& choice, Programs& programs)
{
    check_narrow(choice.narrow, choice.keep_adjacent);
    const ColliderEntry& entry = find_collider(choice.name);
    check_filter(choice, entry);
    if (choice.first && !entry.ends_early)
        throw BadUsage("the collider " + choice.name +
                       " finds all pairs; leaf ends at the first contact, as 'first' asks");
    if (entry.outside != nullptr)
        return outside::make_collider(*entry.outside, entry.refits, programs.device(), choice,
                                      choice.is_within() ? choice.distance : std::nullopt);
    if (entry.make == nullptr)
        throw Unavailable(std::string(entry.absent));
    return entry.make(programs, choice);
}

}  // namespace bvhbench
