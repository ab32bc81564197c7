// SPDX-License-Identifier: MIT
#include "harness/record/record.h"

#include <array>
#include <cmath>
#include <filesystem>

#include "geometry/hash.h"
#include "harness/choice/choices.h"

namespace bvhbench {

BVHBENCH_TO_JSON(StageTime, stage, launches, busy_ns, span_ns, moved_bytes, start_ns, queued_ns,
                 submitted_ns)
BVHBENCH_TO_JSON(Outlier, of, triangle, diameters)
BVHBENCH_TO_JSON(FirstRun, compile_ns, run_ns)
BVHBENCH_TO_JSON(MeshFacts, unused_vertices, weldable_vertices, shared_edges, open_edges,
                 nonmanifold_edges, without_area, duplicate, equal, low, high, longest_edge,
                 median_edge, float_step, expected_pairs)
BVHBENCH_TO_JSON(Reading, polygons_cut, polygons_concave, polygons_crossing, joined_vertices,
                 surprises, ignored)

static void to_json(Json& json, const FeatureFacts& features)
{
    json = {{"pairs", features.pairs}};
    put_if(json, "to_frame", features.to_frame);
    json["primitives"] = features.primitives;
}

static void to_json(Json& json, const Sample& sample)
{
    json = {{"order", sample.order}, {"stages", Json::array()}};
    for (const StageTime& time : sample.stages)
        if (time.wall_ns > 0)  // else a device stage; a tree of one leaf has no launches
            json["stages"].push_back({{"stage", time.stage}, {"wall_ns", time.wall_ns}});
        else
            json["stages"].push_back(time);
    put_if(json, "wall_ns", sample.wall_ns);
    put_if(json, "calibration_ns", sample.calibration_ns);
    put_if(json, "drifted", sample.drifted);
}

namespace {

Json json_of(const SceneFacts& scene)
{
    Json json = {{"name", scene.name}};
    put_if(json, "objects_by", scene.objects_by);
    put_if(json, "between", scene.between);
    put_if(json, "exclude", scene.exclude);
    put_if(json, "filter_hash", scene.filter_hash != 0 ? hex(scene.filter_hash) : "");
    if (scene.triangles > 0) {
        json["triangles"] = scene.triangles;
        json["vertices"] = scene.vertices;
        json["objects"] = scene.objects;
        json["frame"] = scene.frame;
        put_if(json, "source", scene.source);
        put_if(json, "stand_in_for", scene.stand_in_for);
        if (!scene.outlier.of.empty())
            json["outlier"] = scene.outlier;
        if (const Rounding& rounding = scene.rounding; rounding.how)
            json["doubles"] = {
                {"how", doubles_name(*rounding.how)},
                {"offset", {rounding.offset.x, rounding.offset.y, rounding.offset.z}},
                {"scale_log2", rounding.scale_log2},
                {"rounded_count", rounding.rounded_count},
                {"largest_error", rounding.largest_error}};
        put_if(json, "bend_of", scene.bend_of);
        if (scene.mesh) {
            json["mesh"] = *scene.mesh;
            json["reading"] = scene.reading;
        }
        if (scene.content_hash != 0)  // no process of a cluster may have the whole scene
            json["content_hash"] = hex(scene.content_hash);
    }
    return json;
}

Json json_of(const Check& check)
{
    Json json = {{"verdict", verdict_name(check.verdict)}};
    put_if(json, "against", check.against);
    put_if(json, "detail", check.detail);
    for (const auto& [key, hash] :
         {std::pair("tree_hash", check.tree_hash), std::pair("pairs_hash", check.pairs_hash),
          std::pair("contacts_hash", check.contacts_hash)})
        if (hash)
            json[key] = hex(*hash);
    return json;
}

}  // namespace

std::string scene_text(const SceneFacts& scene) { return one_line(json_of(scene)); }

std::string cell_text(const Cell& cell)
{
    constexpr std::array states = {"measured", "skipped", "failed"};
    Json json = {{"experiment", cell.experiment},
                 {"scene", json_of(cell.scene)},
                 {"builder",
                  {{"name", cell.builder.name},
                   {"options", choices_json({.builder = cell.builder}, Choice::Of::builder)}}}};
    if (!cell.collider.name.empty()) {
        Json options = choices_json({.collider = cell.collider}, Choice::Of::query);
        options.update(choices_json({.collider = cell.collider}, Choice::Of::collider));
        json["collider"] = {{"name", cell.collider.name}, {"options", std::move(options)}};
    }
    for (const std::string& name : {cell.builder.name, cell.collider.name, cell.accuracy.method})
        if (const outside::Library* library = outside_library(name))
            json["outside"] = {{"name", name},
                               {"library", library->name},
                               {"version", library->version},
                               {"licence", library->licence},
                               {"device", library->device},
                               {"file", std::filesystem::path(library->file).filename().string()},
                               {"as", library->is_program ? "program" : "plugin"}};
    if (!cell.features.pairs.empty())
        json[cell.features.to_frame > 0 ? "swept" : "features"] = cell.features;
    if (!cell.accuracy.axis.empty())
        json["accuracy"] = {{"axis", cell.accuracy.axis}, {"method", cell.accuracy.method}};
    if (cell.accuracy.seed > 0)
        json["accuracy"]["seed"] = cell.accuracy.seed;
    put_if(json, "cluster", cell.cluster);
    json["operation"] = operation_name(cell.operation);
    json["status"] = states[static_cast<std::size_t>(cell.status)];
    if (cell.status != Cell::Status::measured) {
        json["reason"] = cell.reason;
        return one_line(json);
    }
    json["warm_up"] = cell.warm_up;
    if (cell.first.run_ns > 0)
        json["first"] = cell.first;
    if (cell.sampling.stopped != Stopped::not_sampled) {
        json["sampling"] = {{"stopped", stopped_name(cell.sampling.stopped)},
                            {"caches", caches_name(cell.sampling.caches)}};
        put_if(json["sampling"], "until", cell.sampling.until);
        put_if(json["sampling"], "dropped", cell.sampling.dropped);
        put_if(json["sampling"], "race", race_name(cell.sampling.race));
    }
    json["samples"] = cell.samples;
    Json& counters = json["counters"] = Json::object();
    for (const auto& [key, value] : cell.counters) {
        const bool is_whole = value == std::floor(value) && std::fabs(value) < 0x1p53;
        if (std::isfinite(value))
            counters[key] = is_whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
    }
    put_if(json, "left_out", cell.left_out);
    put_if(json, "leaves_by_depth", cell.leaves_by_depth);
    json["check"] = json_of(cell.check);
    if (cell.within_distance)
        json["within_distance"] = *cell.within_distance;
    if (cell.separation)
        json["separation"] = *cell.separation;
    if (cell.first_contact)
        json["first_contact"] = *cell.first_contact;
    for (const auto& [object, of] : cell.contained)
        json["contained"].push_back({{"object", object}, {"inside", of}});
    return one_line(json);
}

std::string cell_text(const StressCell& cell)
{
    Json json = {{"family", cell.family}, {"scene", cell.scene}};
    put_if(json, "triangles", cell.triangles);
    json["system"] = cell.system;
    json["kind"] = stress_kind_names[static_cast<std::size_t>(cell.kind)];
    put_if(json, "library", cell.library);
    json["findings"] = Json::object();
    for (const auto& [invariant, finding] : cell.findings) {
        Json& entry = json["findings"][std::string(name_of(invariant))];
        entry = {{"verdict", stress_verdict_names[static_cast<std::size_t>(finding.verdict)]},
                 {"checked", finding.checked},
                 {"wrong", finding.wrong},
                 {"missed", finding.missed}};
        put_if(entry, "detail", finding.detail);
    }
    return one_line(json);
}

}  // namespace bvhbench
