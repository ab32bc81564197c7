// SPDX-License-Identifier: MIT
#include "harness/measure/device_verdict.h"

#include "collide/oracles/pair_sets.h"
#include "geometry/host_memory.h"
#include "harness/judge/pair_counts.h"

namespace bvhbench {
constexpr std::size_t sample_size = 10'000;

PairFacts facts_on_device(Session& session, Pipeline& pipeline)
{
    return facts_on_device(session.programs(), pipeline.device_pairs(),
                           static_cast<std::uint64_t>(pipeline.counters().at("pairs_count")),
                           session.queue());
}

Check verdict_of_devices(Session& session, Pipeline& pipeline, const ColliderChoice& choice,
                         const Input& input)
{
    const PairFacts facts = facts_on_device(session, pipeline);
    const TriangleSample sample(input.triangle_count(), sample_size);
    const PairList of_sample(sample.of_device(session.programs(), pipeline.device_pairs(),
                                              facts.count, session.queue()));

    const bool grid_can = choice.name != "grid" && choice.filter.is_empty();
    const ColliderChoice other = {
        {.among = choice.among, .keep_adjacent = choice.keep_adjacent, .filter = choice.filter},
        grid_can                ? "grid"
        : choice.name == "leaf" ? "bvtt"
                                : "leaf"};
    Pipeline second(session, {.name = grid_can ? "none" : "oibvh-multi"}, other, input);
    second.prepare(input);
    const PairFacts others = facts_on_device(session, second);

    require_host_memory("checking the pairs of a sample", input.faces.size() * sizeof(Aabb));
    const PairList right = sample.by_brute_force(
        leaf_boxes(input),
        {input.faces, choice.keep_adjacent, input.objects, choice.among, choice.filter});

    Check check = {.verdict = Check::Verdict::agrees,
                   .against = other.name + ", brute over a sample",
                   .detail = "too many to list: " + facts_text(facts)};
    if (others != facts)
        check.find_wrong(other.name + " found " + facts_text(others));
    if (of_sample != right || of_sample.surplus() > 0)
        check.find_wrong("brute force found " + std::to_string(right.size()) +
                         " pairs with one of " + std::to_string(sample.ids().size()) +
                         " triangles, not " + std::to_string(of_sample.size()));
    return check;
}

}  // namespace bvhbench
