// SPDX-License-Identifier: MIT
#include "harness/accuracy/narrow_truth.h"

#include <algorithm>
#include <future>
#include <thread>

#include "collide/oracles/exact_reference.h"

namespace bvhbench {

std::vector<Pair> pairs_of_neighbours(const Mesh& mesh)
{
    std::vector<Pair> pairs;
    pairs.reserve(mesh.faces.size() / 2);
    for (uint k = 0; k + 1 < mesh.faces.size(); k += 2)
        pairs.push_back({k, k + 1});
    return pairs;
}

PairList neighbours_that_meet(const Mesh& mesh)
{
    const std::vector<Pair> pairs = pairs_of_neighbours(mesh);
    const std::size_t workers = std::max(1u, std::thread::hardware_concurrency());
    const std::size_t share = pairs.size() / workers + 1;
    std::vector<std::future<PairList>> parts;
    for (std::size_t first = 0; first < pairs.size(); first += share)
        parts.push_back(std::async(std::launch::async, [&mesh, &pairs, first, share] {
            const std::size_t end = std::min(pairs.size(), first + share);
            return intersecting_pairs(mesh.points, mesh.faces,
                                      PairList({pairs.begin() + static_cast<std::ptrdiff_t>(first),
                                                pairs.begin() + static_cast<std::ptrdiff_t>(end)}),
                                      false);
        }));
    std::vector<Pair> meeting;
    for (auto& part : parts) {
        const PairList found = part.get();
        meeting.insert(meeting.end(), found.pairs().begin(), found.pairs().end());
    }
    return PairList(std::move(meeting));
}

}  // namespace bvhbench
