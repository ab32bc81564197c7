// SPDX-License-Identifier: MIT
//
// Stress tests: systems over scenes that are hard for them. Systems are builders, colliders over their trees, and libraries
// called as their manuals show.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/judge/check.h"
#include "harness/measure/run.h"
#include "harness/session/session.h"
#include "harness/stress/judge.h"

namespace bvhbench {

/// Options of a stress run: its size, and a filter for cells by "family/scene/system".
struct StressTask {
    StressSize size;
    CellFilter filter;

    bool wants(const StressCell& cell) const
    {
        return passes(filter, cell.family + '/' + cell.scene + '/' + cell.system);
    }
};

/// Runs every system over every scene that it is meant for, family by family, and passes each cell to `add` when it is done. A
/// failure is a finding, and the run continues.
void stress_all(Session& session, const StressTask& task,
                const std::function<void(StressCell&&)>& add);

/// A value that is computed on first use.
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

/// A scene and the data that the systems judged over it share.
struct SceneUnderStress {
    SceneUnderStress(Session& session, std::function<StressScene()> make, std::uint64_t seed);

    Lazy<StressScene> scene;
    Lazy<PairList> pairs;  ///< pairs of overlapping boxes
    Lazy<Input> input;     ///< all triangles as one object
    Lazy<Oracle> oracle;   ///< oracle of that input
    Lazy<StressQuestion> question, question_apart;
    std::map<std::string_view, std::uint64_t> hashes = {};  ///< of large trees, by reference name
};

/// A system and the function that judges it over a scene. It returns nothing if the system does not apply to this device.
struct StressSystem {
    StressCell cell;  ///< the cell to be filled in, with system, kind and library set
    std::function<std::optional<Findings>(SceneUnderStress&)> judge;
};
StressSystem stress_system(std::string name, StressCell::Kind kind, std::string library,
                           std::function<std::optional<Findings>(SceneUnderStress&)> judge);

/// Runs `judge` through the engine like every measured cell (harness/measure/engine.h) and turns a failure into a finding:
/// `refused` if the system may refuse or does not support its options, else `broken`.
Findings settled(Session& session, bool may_refuse, const std::function<Findings()>& judge);

/// Returns the name of a builder's system, such as "oibvh-multi in u16", or of a pipeline's.
std::string system_name(const BuilderChoice& builder);
std::string system_name(const BuilderChoice& builder, const ColliderChoice& collider);

/// Returns the builder `name` with boxes in the format `boxes`, from sorted leaves if the format needs them.
BuilderChoice in_format(std::string_view name, std::string_view boxes);

/// Builder that is tested in other box formats if there is time for only one.
inline constexpr std::string_view builder_in_formats = "oibvh-multi";

/// Returns the available builders whose kernels run on the device.
std::vector<BuilderChoice> device_builders(Session& session);

/// Judges a builder over all triangles as one object: every check of harness/judge/check.h and the layout. `repeats` more builds
/// must leave the same tree.
Findings judge_builder(Session& session, const BuilderChoice& builder, SceneUnderStress& scene,
                       int repeats);

/// Judges one build past 2^24 leaves: launches, layout, leaves, boxes. Builders with one reference must leave equal trees.
Findings judge_large_build(Session& session, const BuilderChoice& builder, SceneUnderStress& scene);

/// A builder and a collider over its trees, or a collider without a tree.
struct StressPipeline {
    BuilderChoice builder;
    ColliderChoice collider;
    bool is_library = false;
};

/// Returns the possible pipelines: every collider over one tree of each traversal header that it accepts (trees themselves are
/// judged with the builders); with `other_forms`, some with kernels in the form that is not the device's own; some with every
/// other box format. With `few`, over fewer trees.
std::vector<StressPipeline> stress_pipelines(Session& session, bool few, bool other_forms);

/// Returns a finder that runs one frame of the pipeline and, if the collider keeps its tree, a second frame, which must find the
/// same. The finder throws what pipelines throw.
PairFinder finder_of(Session& session, const StressPipeline& pipeline);

/// Judges whether a pipeline finds the same in `repeats` more frames as in the first.
Findings judge_frames(Session& session, const StressPipeline& pipeline, const StressScene& scene,
                      int repeats);

/// Judges a pipeline with a question.
Findings judge_pipeline(Session& session, const StressPipeline& pipeline,
                        const StressQuestion& question);

/// Returns one system for each group-size parameter and each builder's --group-size option; each tries all values.
std::vector<StressSystem> group_size_systems(Session& session, bool few);

/// A row of the table: a scene and the systems that are judged over it.
struct StressPart {
    std::string family;
    StressCase scene;
    std::vector<StressSystem> systems;
};

/// Returns the scenes of each family, then the families layout, group-sizes and repeats.
std::vector<StressPart> stress_parts(Session& session, const StressSize& size);

/// Checks the layout's formulas up to 2^31 leaves by arithmetic alone.
Findings judge_layout_formulas(const StressSize& size);

}  // namespace bvhbench
