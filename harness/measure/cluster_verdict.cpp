// SPDX-License-Identifier: MIT
#include "harness/measure/cluster_verdict.h"

#include "collide/oracles/pair_sets.h"
#include "geometry/error.h"
#include "harness/judge/pair_counts.h"
#include "harness/measure/cluster_part.h"

namespace bvhbench {
namespace {

/// Returns a verdict that agrees, unless a pair is found twice.
Check begun(const ClusterEvidence& evidence, const std::string& against)
{
    Check check{.verdict = Check::Verdict::agrees, .against = against};
    if (evidence.list)
        check.pairs_hash = evidence.list->hash();
    if (evidence.contact_list)
        check.contacts_hash = evidence.contact_list->hash();
    if (evidence.list && evidence.list->surplus() > 0)
        check.find_wrong(std::to_string(evidence.list->surplus()) + " pairs are found twice");
    return check;
}

}  // namespace

Check verdict_of_one_device(const ClusterEvidence& evidence, std::span<const Point> points,
                            std::span<const Face> faces, Session& session,
                            const PipelineChoice& pipeline)
{
    Check check = begun(evidence, "one device");
    try {
        Queue& queue = session.queue();
        const Input input = upload(session.device(), queue, points, faces);
        const auto builder = make_builder(pipeline.builder, session.programs());
        const auto collider = make_collider(pipeline.collider, session.programs());
        builder->reserve(input.triangle_count());
        const PairTest test = test_of(pipeline.collider);
        std::optional<PairDecider> decider;
        std::optional<Input> padded;
        if (test.decides()) {
            decider.emplace(session.programs(), test);
            decider->reserve(points.size(), faces.size());
            padded = decider->padded(input, queue);
        }
        const Input& boxed = padded ? *padded : input;
        const Tree& tree = builder->build(boxed, queue);
        collider->reserve(&tree, boxed);
        find_pairs(*collider, &tree, boxed, queue);
        queue.finish();
        const PairFacts right = facts_on_device(session.programs(), collider->device_pairs(queue),
                                                collider->counts(queue).pairs, queue);
        if (evidence.facts != right ||
            (evidence.list && *evidence.list != PairList(collider->pairs(queue))))
            check.find_wrong("it finds " + facts_text(right) + ", not " +
                             facts_text(evidence.facts));
        if (!decider)
            return check;
        decider->decide(input, collider->device_pairs(queue), queue);
        std::vector<Pair> contacts = decider->pairs(queue);
        const PairFacts facts = facts_of(contacts);
        if (*evidence.contacts != facts ||
            (evidence.contact_list && *evidence.contact_list != PairList(std::move(contacts))))
            check.find_wrong("of contacts, it finds " + facts_text(facts) + ", not " +
                             facts_text(*evidence.contacts));
    } catch (const Unavailable& error) {  // the scene may be too large for one device
        session.renew_queue();
        if (check.verdict == Check::Verdict::agrees)
            check.verdict = Check::Verdict::not_checked;
        check.detail +=
            (check.detail.empty() ? "" : "; ") + std::string("one device cannot: ") + error.what();
    }
    return check;
}

Check verdict_of_partitions(const ClusterEvidence& evidence)
{
    Check check = begun(evidence, "the other partition, brute over a sample");
    if (evidence.other_partition != evidence.facts)
        check.find_wrong("the other partition has " + facts_text(evidence.other_partition) +
                         ", not " + facts_text(evidence.facts));
    if (evidence.other_contacts != evidence.contacts)
        check.find_wrong("of contacts, the other partition has " +
                         facts_text(*evidence.other_contacts) + ", not " +
                         facts_text(*evidence.contacts));
    const PairList found(evidence.of_sample), right(evidence.right_of_sample);
    if (found != right || found.surplus() > 0 || right.surplus() > 0)
        check.find_wrong("brute force finds " + std::to_string(right.size()) +
                         " pairs with a triangle of the sample, not " +
                         std::to_string(evidence.of_sample.size()));
    return check;
}

}  // namespace bvhbench
