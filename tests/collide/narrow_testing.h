// SPDX-License-Identifier: MIT
//
// What the tests of the narrow phase share: candidates on the device, as a broad phase would have left them.
#pragma once

#include <gtest/gtest.h>

#include <iterator>

#include "collide/counters.h"
#include "collide/narrow/narrow.h"
#include "collide/oracles/exact_reference.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {

/// A mesh and candidates of it on the device.
struct Candidates {
    Mesh mesh;
    PairList pairs;
    Input input;
    Buffer<Pair> on_device;
    Buffer<uint> counters;
    Arena arena;

    Candidates(const Mesh& of, std::vector<Pair> found)
        : mesh(of)
        , pairs(found)
        , input(upload(bench().device, bench().queue, mesh.points, mesh.faces))
        , arena(reserved(found.size()))
    {
        const auto count = static_cast<uint>(found.size());
        const std::vector<uint> counts = {count, 0, 0, 0};
        found.resize(found.size() + 1);  // what is behind the last must not be looked at
        take_all(arena, found.size());
        on_device.upload(bench().queue.cl(), std::span<const Pair>(found));
        counters.upload(bench().queue.cl(), std::span<const uint>(counts));
    }

private:
    void take_all(Arena& from, std::size_t count)
    {
        on_device = from.take<Pair>(count, Use::scratch);
        counters = from.take<uint>(4, Use::scratch);
    }
    Arena reserved(std::size_t count)
    {
        Arena measuring = Arena::measuring(bench().device);
        take_all(measuring, count + 1);
        return Arena::reserved(bench().device, measuring.used());
    }
};

/// Of a mesh made of pairs: 0 with 1, 2 with 3.
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

/// The contacts that a query finds, repeated until it is complete.
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

/// Pair for pair, with the first that differ spelled out.
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
