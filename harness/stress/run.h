// SPDX-License-Identifier: MIT
//
// Stress: systems over scenes that are hard on them. Who is put under stress are builders, colliders over their trees, and
// libraries as their manuals show them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/pattern.h"
#include "harness/judge/check.h"
#include "harness/session/session.h"
#include "harness/stress/judge.h"

namespace bvhbench {

/// What is asked for: cells whose "family/scene/system" the filter matches.
struct StressTask {
    StressSize size;
    std::optional<Pattern> filter;

    bool wants(const StressCell& cell) const
    {
        return !filter || filter->is_in(cell.family + '/' + cell.scene + '/' + cell.system);
    }
};

/// Every system over every scene that it is for, family by family. Cells go to `add` as they are done. What fails is a
/// finding, and the run goes on.
void stress_all(Session& session, const StressTask& task,
                const std::function<void(StressCell&&)>& add);

/// Made when it is first asked for.
template <class T>
class Lazy {
public:
    explicit Lazy(std::function<T()> make) : make_(std::move(make)) {}

    T& operator()()
    {
        if (!value_)
            value_.emplace(make_());
        return *value_;
    }
    void forget() { value_.reset(); }

private:
    std::function<T()> make_;
    std::optional<T> value_;
};

/// A scene, and what the systems over it share.
struct SceneUnderStress {
    SceneUnderStress(Session& session, std::function<StressScene()> make, std::uint64_t seed);

    Lazy<StressScene> scene;
    Lazy<PairList> pairs;  ///< of boxes that overlap
    Lazy<Input> input;     ///< all triangles as one object
    Lazy<Oracle> oracle;   ///< of that input
    Lazy<StressQuestion> question, question_apart;
    std::map<std::string_view, std::uint64_t> hashes =
        {};  ///< of large trees, by the reference's name
};

/// A system, and how it is judged over a scene: nothing where it says nothing about this device.
struct StressSystem {
    StressCell cell;  ///< that is to be, with the system and whose it is
    std::function<std::optional<Findings>(SceneUnderStress&)> judge;
};
StressSystem stress_system(std::string name, StressCell::Kind kind, std::string library,
                           std::function<std::optional<Findings>(SceneUnderStress&)> judge);

/// What `judge` finds, settled as every cell that is measured (harness/measure/engine.h), so that a failure is a finding:
/// it is refused where the system may refuse, or cannot have such options, and broken else.
Findings settled(Session& session, bool may_refuse, const std::function<Findings()>& judge);

/// The name of a builder's system, "oibvh-multi in u16", and of a pipeline's.
std::string system_name(const BuilderChoice& builder);
std::string system_name(const BuilderChoice& builder, const ColliderChoice& collider);

/// The builder of that name, its boxes in that format, for which leaves are sorted where they have to be.
BuilderChoice in_format(std::string_view name, std::string_view boxes);

/// Whose trees are put under stress in other formats where there is time for one builder only.
inline constexpr std::string_view builder_in_formats = "oibvh-multi";

/// The builders that are there and whose kernels run on the device.
std::vector<BuilderChoice> device_builders(Session& session);

/// A builder over all triangles as one object: every promise of harness/judge/check.h, and what is about its layout.
/// `repeats` more builds must leave the same tree.
Findings judge_builder(Session& session, const BuilderChoice& builder, SceneUnderStress& scene,
                       int repeats);

/// One build past 2^24 leaves: its launches, layout, leaves and boxes. Builders with one reference must leave one tree.
Findings judge_large_build(Session& session, const BuilderChoice& builder, SceneUnderStress& scene);

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

/// Runs a frame of such a pipeline; if it goes on from frame to frame, a second one, which must find the same. Throws
/// what pipelines throw.
PairFinder finder_of(Session& session, const StressPipeline& pipeline);

/// One and the same pipeline, so many frames more than the first: whether it finds the same each time.
Findings judge_frames(Session& session, const StressPipeline& pipeline, const StressScene& scene,
                      int repeats);

/// Findings over a question.
Findings judge_pipeline(Session& session, const StressPipeline& pipeline,
                        const StressQuestion& question);

/// Every group size that a parameter or a builder's own option may have on this device, a system each.
std::vector<StressSystem> group_size_systems(Session& session, bool few);

/// A row of the table: a scene, and the systems that are judged over it.
struct StressPart {
    std::string family;
    StressCase scene;
    std::vector<StressSystem> systems;
};

/// Each family's scenes; layouts, group sizes and repetitions are families after those of scenes.
std::vector<StressPart> stress_parts(Session& session, const StressSize& size);

/// The formulas of the layout up to 2^31 leaves, in arithmetic alone.
Findings judge_layout_formulas(const StressSize& size);

}  // namespace bvhbench
