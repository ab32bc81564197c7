// SPDX-License-Identifier: MIT
//
// Verdicts on the pairs that ranks found: against one device, or, of scenes that none can hold, against another partition and
// against brute force over a sample of triangles.
#pragma once

#include <optional>
#include <vector>

#include "collide/pairs.h"
#include "harness/choice/scene_choice.h"
#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// What is known of the pairs of all ranks, by scene numbers.
struct ClusterEvidence {
    PairFacts facts;
    std::optional<PairList> list;       ///< empty if there are too many to gather
    std::optional<PairFacts> contacts;  ///< empty without a narrow phase
    std::optional<PairList> contact_list;

    // Only where no device can find them alone:
    PairFacts other_partition;
    std::optional<PairFacts> other_contacts;
    std::vector<Pair> of_sample;        ///< those of them that have a triangle of the sample
    std::vector<Pair> right_of_sample;  ///< by brute force
};

/// Compares with what this process' device finds in the whole scene, with the same pipeline: list for list, or only the facts if
/// there is no list.
Check verdict_of_one_device(const ClusterEvidence& evidence, std::span<const Point> points,
                            std::span<const Face> faces, Session& session,
                            const PipelineChoice& pipeline);

/// Compares the facts with those of another partition, and the pairs of the sample's triangles list for list.
Check verdict_of_partitions(const ClusterEvidence& evidence);

}  // namespace bvhbench
