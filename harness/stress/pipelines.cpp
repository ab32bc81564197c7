// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <set>

#include "builders/device_tree.h"
#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/measure/pipeline.h"
#include "harness/stress/run.h"

namespace bvhbench {
namespace {

// A binary tree, two wide ones, and one with child pointers.
constexpr std::string_view some_builders[] = {"oibvh-multi", "oibvh-wide4", "oibvh-wide8",
                                              "karras"};

/// A collider, builder and box format to test together. A few suffice: a format changes how kernels read boxes, nothing else.
struct InFormat {
    std::string_view collider, builder, boxes;
};
constexpr InFormat some_formats[] = {
    {"leaf", builder_in_formats, "f64"},
    {"leaf", builder_in_formats, "u8"},
    {"group", builder_in_formats, "u16"},
    {"block", builder_in_formats, "u16"},
    {"bvtt", builder_in_formats, "f16"},
    {"front", builder_in_formats, "f64"},
    {"leaf", "karras", "f16"},
    {"front", "karras", "u8"},
    {"front-leaf", "karras", "u16"},
    {"group", "apetrei", "u16"},
    {"bvtt", "karras", "f64"},
};

/// Returns a builder's tree over one triangle.
const Tree& smallest_tree(Session& session, const BuilderChoice& choice)
{
    static const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const Input input = upload(session.device(), session.queue(), mesh.points, mesh.faces);
    return built_tree(session, choice, input);
}

/// Returns one builder for each traversal header: those above, and the first with any other header.
std::vector<std::string> tree_builders(Session& session, bool few)
{
    std::vector<std::string> names(std::begin(some_builders), std::end(some_builders));
    if (few)
        return names;
    std::set<std::string_view> headers;
    const auto is_new = [&](const std::string& name) {
        const auto* tree = dynamic_cast<const DeviceTree*>(&smallest_tree(session, {.name = name}));
        return tree != nullptr && headers.insert(tree->access_header()).second;
    };
    for (const std::string& name : names)
        is_new(name);
    for (const PipelineChoice& one : device_builders(session))
        if (is_new(one.builder.name))
            names.push_back(one.builder.name);
    return names;
}

Input uploaded(Session& session, const StressScene& scene)
{
    return upload(session.device(), session.queue(), scene.mesh.points, scene.mesh.faces,
                  scene.objects);
}

/// Returns what the pipeline finds in one more frame over the same points.
FoundPairs found_next(Pipeline& pipeline, const PipelineChoice& chosen, const Input& input)
{
    pipeline.begin_frame({});
    pipeline.prepare(input);
    FoundPairs found;
    found.is_rounded = find_box_format(chosen.builder.boxes).has_cells();
    if (pipeline.has_pairs())
        found.pairs = PairList(pipeline.pairs());
    if (pipeline.has_contacts())
        found.contacts = PairList(pipeline.contacts());
    return found;
}

}  // namespace

BuilderChoice in_format(std::string_view name, std::string_view boxes)
{
    return {{.sorted_leaves = boxes != "f32", .boxes = std::string(boxes)}, std::string(name)};
}

bool is_library(const PipelineChoice& choice)
{
    return is_builder(choice) ? find_builder(choice.builder.name).is_library
                              : find_collider(choice.collider.name).is_library;
}

std::string system_name(const PipelineChoice& choice)
{
    const auto& [builder, collider] = choice;
    std::string name = collider.name;
    if (!builder.name.empty())
        name += (name.empty() ? "" : " over ") + builder.name;
    if (builder.boxes != "f32")
        name += " in " + builder.boxes;
    if (collider.form != KernelForm::of_device)
        name += collider.form == KernelForm::groups ? ", groups" : ", chunks";
    return name;
}

std::vector<PipelineChoice> stress_pipelines(Session& session, bool few, bool other_forms)
{
    const KernelForm other = session.device().is_cpu() ? KernelForm::groups : KernelForm::chunks;
    const std::vector<std::string> builders = tree_builders(session, few);
    std::vector<PipelineChoice> pipelines;
    for (const ColliderEntry& entry : collider_catalog()) {
        if (entry.make == nullptr)
            continue;
        ColliderChoice choice;
        choice.name = entry.name;
        choice.narrow = "exact";
        choice.keep_adjacent = false;  // as libraries do
        std::unique_ptr<Collider> collider;
        reason_of_failure([&] { collider = make_collider(choice, session.programs()); });
        choice.keep_adjacent = collider != nullptr && !collider->finds_contacts();
        // A collider that cannot be made is judged as well, to report the reason.
        if (collider == nullptr || !collider->needs_tree()) {
            pipelines.push_back({{.name = ""}, choice});
            continue;
        }
        std::vector<PipelineChoice> over;
        for (const std::string& name : builders)
            // If the tree cannot be built, judge_builder reports the reason.
            reason_of_failure([&] {
                if (collider->refusal(smallest_tree(session, {.name = name})).empty())
                    over.push_back({{.name = name}, choice});
            });
        pipelines.insert(pipelines.end(), over.begin(), over.end());
        over.resize(other_forms ? std::min(over.size(), few ? 1 : std::size(some_builders)) : 0);
        for (PipelineChoice& one : over) {
            one.collider.form = other;
            pipelines.push_back(one);
        }
        for (const InFormat& one : some_formats)
            if (one.collider == entry.name)
                pipelines.push_back({in_format(one.builder, one.boxes), choice});
    }
    return pipelines;
}

PairFinder finder_of(Session& session, const PipelineChoice& chosen)
{
    return [&session, chosen](const StressScene& scene, std::size_t capacity) {
        const Input input = uploaded(session, scene);
        ColliderChoice collider = chosen.collider;
        collider.capacity = capacity;
        Pipeline pipeline(session, chosen.builder, collider, input);
        const FoundPairs found = found_next(pipeline, chosen, input);
        if (pipeline.collider().keeps_tree() && found_next(pipeline, chosen, input) != found)
            throw Unavailable("two frames in a row over the same points found different pairs");
        return found;
    };
}

Findings judge_pipeline(SceneUnderStress& scene, const PipelineChoice& chosen)
{
    Session& session = scene.session;
    const StressQuestion& question =
        chosen.collider.keep_adjacent ? scene.question() : scene.question_apart();
    // A library's collider may refuse a scene with any error; this project's may do so with BadUsage only.
    return findings_of(session, is_library(chosen), [&]() -> Findings {
        if (scene.repeats == 0)
            return judge_finder(finder_of(session, chosen), question);
        const Input input = uploaded(session, scene.scene());
        Pipeline pipeline(session, chosen.builder, chosen.collider, input);
        const FoundPairs first = found_next(pipeline, chosen, input);
        return {{Invariant::same, judge_repeats(scene.repeats, [&] {
                     return found_next(pipeline, chosen, input) == first;
                 })}};
    });
}

Findings judge_large_query(SceneUnderStress& scene, const PipelineChoice& chosen)
{
    PipelineChoice pipeline = chosen;
    pipeline.collider.narrow = "none";
    const PairList& expected = scene.pairs();
    scene.input.value.reset();  // frees memory: the pipeline uploads its own input
    Findings findings = findings_of(scene.session, false, [&]() -> Findings {
        const FoundPairs found = finder_of(scene.session, pipeline)(scene.scene(), 0);
        return {{Invariant::pairs, judge_pairs(*found.pairs, expected)}};
    });
    // A device may lack memory at this size; refusing with one sentence is then accepted.
    if (Finding& ends = findings[Invariant::ends]; ends.detail.starts_with("out of device memory"))
        ends = {Finding::Verdict::refused, 1, 0, 0, ends.detail};
    return findings;
}

}  // namespace bvhbench
