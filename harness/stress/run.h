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

#include "collide/oracles/box_pairs.h"
#include "harness/choice/scene_choice.h"
#include "harness/judge/check.h"
#include "harness/measure/run.h"
#include "harness/session/session.h"
#include "harness/stress/judge.h"

namespace bvhbench {

/// Options of a stress run: its size, and a filter for cells by "family/scene/system".
struct StressTask {
    StressSize size;
    CellFilter filter;
};

/// Runs every system over every scene that it is meant for, family by family, and passes each cell to `add` when it is done. A
/// failure is a finding, and the run continues.
void stress_all(Session& session, const StressTask& task,
                const std::function<void(StressCell&&)>& add);

/// A value that is computed on first use, and again after it was reset.
template <class T>
struct Lazy {
    std::function<T()> make;
    std::optional<T> value = {};

    T& operator()() { return value ? *value : value.emplace(make()); }
};

/// A scene and the data that the systems judged over it share.
struct SceneUnderStress {
    Session& session;
    std::string name;
    std::uint64_t seed;
    int repeats;  ///< as in StressPart
    Lazy<StressScene> scene;
    Lazy<PairList> pairs = {[this] {  ///< pairs of overlapping boxes
        return touching_pairs(scene().mesh.points, scene().mesh.faces, true);
    }};
    Lazy<Input> input = {[this] {  ///< all triangles as one object
        return upload(session.device(), session.queue(), scene().mesh.points, scene().mesh.faces);
    }};
    Lazy<Oracle> oracle = {[this] { return Oracle(session, input()); }};
    Lazy<StressQuestion> question = {[this] { return question_of(scene(), seed); }};
    Lazy<StressQuestion> question_apart = {[this] { return without_adjacent(question()); }};
    std::map<std::string_view, std::uint64_t> hashes = {};  ///< of large trees, by reference name
};

/// A system and the function that judges it over a scene. It returns nothing if the system does not apply to this device.
struct StressSystem {
    std::string name;
    StressCell::Kind kind;
    std::string library;  ///< library that the system belongs to; empty: this project
    std::function<std::optional<Findings>(SceneUnderStress&)> judge;
};

/// Runs `judge` through the engine like every measured cell (harness/measure/engine.h) and turns a failure into a finding:
/// `refused` if the system may refuse or does not support its options, else `broken`.
Findings findings_of(Session& session, bool may_refuse, const std::function<Findings()>& judge);

/// True if the choice is a builder alone, without a collider. A collider without a tree has an empty builder name.
inline bool is_builder(const PipelineChoice& choice) { return choice.collider.name.empty(); }

/// True if a library does the work of the builder or, if there is one, of the collider.
bool is_library(const PipelineChoice& choice);

/// Returns the name of a system, such as "leaf over oibvh-multi in u16, groups".
std::string system_name(const PipelineChoice& choice);

/// Returns the builder `name` with boxes in the format `boxes`, from sorted leaves if the format needs them.
BuilderChoice in_format(std::string_view name, std::string_view boxes);

/// Builder that is tested in other box formats if there is time for only one.
inline constexpr std::string_view builder_in_formats = "oibvh-multi";

/// Returns the available builders whose kernels run on the device.
std::vector<PipelineChoice> device_builders(Session& session);

/// Returns the possible pipelines: every collider over one tree of each traversal header that it accepts (trees themselves are
/// judged with the builders); with `other_forms`, some with kernels in the form that is not the device's own; some with every
/// other box format. With `few`, over fewer trees.
std::vector<PipelineChoice> stress_pipelines(Session& session, bool few, bool other_forms);

/// Returns a finder that runs one frame of the pipeline and, if the collider keeps its tree, a second frame, which must find the
/// same. The finder throws what pipelines throw.
PairFinder finder_of(Session& session, const PipelineChoice& pipeline);

/// Judges a builder over all triangles as one object: every check of harness/judge/check.h and the layout. The repeated builds
/// must leave the same tree.
Findings judge_builder(SceneUnderStress& scene, const PipelineChoice& builder);

/// Judges a pipeline over the scene and its variants, or only whether the repeated frames find the same as the first.
Findings judge_pipeline(SceneUnderStress& scene, const PipelineChoice& pipeline);

/// Judges one build past 2^24 leaves: launches, layout, leaves, boxes. Builders with one reference must leave equal trees.
Findings judge_large_build(SceneUnderStress& scene, const PipelineChoice& builder);

/// Judges a query past 2^24 leaves without the narrow phase, since the triangles have no area.
Findings judge_large_query(SceneUnderStress& scene, const PipelineChoice& pipeline);

/// Returns one system for each group-size parameter and each builder's --group-size option; each tries all values.
std::vector<StressSystem> group_size_systems(Session& session, bool few);

/// A row of the table: a scene and the systems that are judged over it.
struct StressPart {
    std::string family;
    StressCase scene;
    std::vector<StressSystem> systems;
    int repeats = 0;  ///< builds and frames after the first; 0: pipelines run over variants instead
};

/// Returns the scenes of each family, then the families layout, group-sizes and repeats.
std::vector<StressPart> stress_parts(Session& session, const StressSize& size);

/// Checks the layout's formulas up to 2^31 leaves by arithmetic alone.
Findings judge_layout_formulas(const StressSize& size);

}  // namespace bvhbench
