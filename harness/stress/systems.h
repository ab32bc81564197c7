// SPDX-License-Identifier: MIT
//
// Who is put under stress: builders, colliders over their trees, and libraries as their manuals show them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/judge/check.h"
#include "harness/session/session.h"
#include "harness/stress/judge.h"

namespace bvhbench {

/// The name of a builder's system, "oibvh-multi in u16", and of a pipeline's.
std::string system_name(const BuilderChoice& builder);
std::string system_name(const BuilderChoice& builder, const ColliderChoice& collider);

/// The builder of that name, its boxes in that format, for which leaves are sorted where they have to be.
BuilderChoice in_format(std::string_view name, std::string_view boxes);

/// Whose trees are put under stress in other formats where there is time for one builder only.
inline constexpr std::string_view builder_in_formats = "oibvh-multi";

/// Whether it is there and its kernels run on the device.
bool builds_on_device(Session& session, const BuilderEntry& entry);

/// A builder over all triangles as one object: every promise of harness/judge/contract.h, and what is about its layout.
/// A failure is a finding. `repeats` more builds must leave the same tree.
Findings judge_builder(Session& session, const BuilderChoice& builder, const Input& input,
                       Oracle& oracle, int repeats);

/// A builder's tree past 2^24 leaves: one build, checked on the host while others build. `check` may be called on any
/// thread; nothing of the session is used by it.
struct LateFindings {
    Findings so_far;
    struct Tree {
        Findings findings;
        std::uint64_t hash = 0;  ///< builders with one oracle leave one tree
    };
    std::function<Tree()> check;
};
LateFindings build_large(Session& session, const BuilderChoice& builder, const Input& input);

/// A builder and a collider over its trees, or a collider without.
struct StressPipeline {
    BuilderChoice builder;
    ColliderChoice collider;
    bool is_library = false;
};

/// Those that can be: every collider over a tree of each way to walk one that it takes (whose trees they are, builders'
/// own findings tell), and, if `other_forms`, over some in the form of kernels that is not the device's; and some over boxes
/// of every other format. If `few`, over fewer.
std::vector<StressPipeline> stress_pipelines(Session& session, bool few, bool other_forms);

/// Whether the form of kernels that is not the device's is put under stress too. On a CPU groups show what they do on a
/// GPU. The kernels for few cores take minutes a scene on a GPU, where nobody runs them: there they are with small scenes.
bool wants_other_forms(const Session& session, const StressSize& size);

/// Runs a frame of such a pipeline; if it goes on from frame to frame, a second one, which must find the same. Throws
/// what pipelines throw.
PairFinder finder_of(Session& session, const StressPipeline& pipeline);

/// One and the same pipeline, so many frames more than the first: whether it finds the same each time.
Findings judge_frames(Session& session, const StressPipeline& pipeline, const StressScene& scene,
                      int repeats);

/// Findings over a question; a failure is a finding, and so is a refusal.
Findings judge_pipeline(Session& session, const StressPipeline& pipeline,
                        const StressQuestion& question);

}  // namespace bvhbench
