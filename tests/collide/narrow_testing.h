// SPDX-License-Identifier: MIT
//
// Shared by the tests of the narrow phase: candidates on the device, as a broad phase would leave them.
#pragma once

#include <array>
#include <iterator>
#include <utility>

#include "collide/counters.h"
#include "collide/device_lists.h"
#include "collide/narrow/narrow.h"
#include "scenes/generate/pair_classes.h"
#include "tests/builders/stage_testing.h"
#include "tests/needing.h"

namespace bvhbench {

/// A mesh, and candidates of it on the device.
struct Candidates {
    Mesh mesh;
    PairList pairs;
    Input input;
    std::optional<Arena> arena;
    Buffer<Pair> on_device;
    Buffer<uint> counters;

    Candidates(const Mesh& of, std::vector<Pair> found)
        : mesh(of)
        , pairs(found)
        , input(upload(bench().device, bench().queue, mesh.points, mesh.faces))
    {
        const std::vector<uint> counts = {static_cast<uint>(found.size()), 0, 0, 0};
        found.resize(found.size() + 1);  // must not be read
        take_memory(arena, bench().device, [&](Arena& from) {
            on_device = from.take<Pair>(found.size(), Use::scratch);
            counters = from.take<uint>(counts.size(), Use::scratch);
        });
        on_device.upload(bench().queue.cl(), found);
        counters.upload(bench().queue.cl(), counts);
    }
};

/// Tests of one class of pairs each.
class OfAClass : public Needing<testing::TestWithParam<PairClass>, cgal_absent> {};

inline constexpr CaseName form_test_name;

inline const auto all_classes = testing::ValuesIn(pair_classes().begin(), pair_classes().end());

/// Returns pairs of a class that share one to three indices, at any corners; some faces name an index twice.
inline Mesh adjacent_pairs(const PairClass& of, uint count)
{
    Mesh mesh = apart_pairs(of, count, count);
    Dice dice(count + 1);
    for (uint k = 0; k < count; ++k) {
        const uint place = 6 * k;
        std::array<uint, 3> first = {place, place + 1, place + 2};
        std::array<uint, 3> second = {place + 3, place + 4, place + 5};
        const uint shared = dice.below(8) == 0 ? 3 : 1 + dice.below(2), turn = dice.below(3);
        for (uint s = 0; s < shared; ++s)
            second[(s + turn) % 3] = first[s];
        if (dice.below(2) == 0)
            std::swap(second[0], second[1]);
        if (dice.below(16) == 0)
            first[dice.below(3)] = first[dice.below(3)];
        if (dice.below(16) == 0)
            second[dice.below(3)] = second[dice.below(3)];
        std::swap(first[0], first[dice.below(3)]);
        mesh.faces[2 * k] = {first[0], first[1], first[2]};
        mesh.faces[2 * k + 1] = {second[0], second[1], second[2]};
    }
    return mesh;
}

/// Returns the pairs of a mesh that consists of pairs of faces: 0 with 1, 2 with 3, ...
inline std::vector<Pair> neighbours(const Mesh& mesh)
{
    std::vector<Pair> pairs;
    for (uint k = 0; k + 1 < mesh.faces.size(); k += 2)
        pairs.push_back({k, k + 1});
    return pairs;
}

inline std::string spelled(const Mesh& mesh, Pair pair)
{
    std::string text;
    for (const uint id : {pair.a, pair.b})
        for (const uint index : {mesh.faces[id].a, mesh.faces[id].b, mesh.faces[id].c}) {
            char corner[100];
            std::snprintf(corner, sizeof corner, "\n  %u (%a, %a, %a)", index,
                          static_cast<double>(mesh.points[index].x),
                          static_cast<double>(mesh.points[index].y),
                          static_cast<double>(mesh.points[index].z));
            text += corner;
        }
    return text;
}

/// Returns the contacts of a query, repeated until it is complete.
inline PairList contacts_found(NarrowPhase& narrow, const Candidates& candidates)
{
    find_contacts(narrow, candidates.input, candidates.on_device, candidates.counters,
                  bench().queue);
    const PairList found(narrow.contacts(bench().queue));
    EXPECT_EQ(found.surplus(), 0u);
    const NarrowCounts counts = narrow.counts(bench().queue);
    EXPECT_EQ(counts.contacts, found.size());
    EXPECT_EQ(counts.candidates(), candidates.pairs.size());
    bench().queue.finish();
    return found;
}

/// Compares two lists pair for pair; the message spells out the first differences.
inline void expect_equal(const Mesh& mesh, const PairList& found, const PairList& wanted)
{
    std::vector<Pair> differ;
    std::set_symmetric_difference(found.pairs().begin(), found.pairs().end(),
                                  wanted.pairs().begin(), wanted.pairs().end(),
                                  std::back_inserter(differ));
    EXPECT_EQ(differ.size(), 0u);
    for (std::size_t k = 0; k < std::min<std::size_t>(differ.size(), 3); ++k)
        ADD_FAILURE() << "differs: " << spelled(mesh, differ[k]);
}

}  // namespace bvhbench
