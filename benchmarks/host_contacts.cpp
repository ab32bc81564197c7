// SPDX-License-Identifier: MIT
#include "benchmarks/host.h"
#include "collide/narrow/double_filter.h"
#include "scenes/generate/pair_classes.h"

namespace bvhbench {
namespace {

constexpr uint pair_count = 4096;

/// Returns how many of the pairs meet. Pairs that the filter in doubles leaves open, or without it all, are decided exactly.
std::uint64_t count_meeting(const Mesh& mesh, bool filtered)
{
    const auto corners = [&](Face face) {
        return Corners{{mesh.points[face.a], mesh.points[face.b], mesh.points[face.c]}};
    };
    std::uint64_t count = 0;
    for (std::size_t k = 0; k < mesh.faces.size(); k += 2) {
        const Corners a = corners(mesh.faces[k]), b = corners(mesh.faces[k + 1]);
        const uint verdict = filtered ? likely_meet(a, b) : VERDICT_UNSURE;
        const bool meet =
            verdict == VERDICT_UNSURE ? triangles_meet(a, b) : verdict == VERDICT_MEET;
        count += meet ? 1 : 0;
    }
    return count;
}

}  // namespace

/// The classes of pairs that all meet by construction, or all do not.
void register_host_contacts(Outcome& outcome)
{
    for (const PairClass& of : pair_classes()) {
        if (of.meeting == Meeting::some)
            continue;
        const Mesh mesh = apart_pairs(of, pair_count, 1);
        for (const bool filtered : {false, true})
            register_host("contacts/" + of.name + (filtered ? "/filtered" : "/exact"), outcome,
                          pair_count, of.meeting == Meeting::all ? pair_count : 0,
                          [=] { return count_meeting(mesh, filtered); });
    }
}

}  // namespace bvhbench
