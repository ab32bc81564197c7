// SPDX-License-Identifier: MIT
#include "harness/record/record.h"

#include <array>
#include <cmath>

#include "geometry/hash.h"
#include "harness/choice/choices.h"

namespace bvhbench {
namespace {

void put_if(Json& json, const char* key, const std::string& value)
{
    if (!value.empty())
        json[key] = value;
}

}  // namespace

static void to_json(Json& json, const StageTime& time)
{
    if (time.wall_ns > 0)  // else a device stage; a tree of one leaf has no launches
        json = {{"stage", time.stage}, {"wall_ns", time.wall_ns}};
    else
        json = {{"stage", time.stage},
                {"launches", time.launches},
                {"busy_ns", time.busy_ns},
                {"span_ns", time.span_ns},
                {"moved_bytes", time.moved_bytes},
                {"start_ns", time.start_ns},
                {"queued_ns", time.queued_ns},
                {"submitted_ns", time.submitted_ns}};
}

static void to_json(Json& json, const Sample& sample)
{
    json = {{"order", sample.order}, {"stages", sample.stages}};
    if (sample.calibration_ns > 0)
        json["calibration_ns"] = sample.calibration_ns;
    if (sample.drifted)
        json["drifted"] = true;
}

/// Defines to_json with one key for each member, named as the member.
#define TO_JSON(Type, ...)                                                       \
    static void to_json(Json& nlohmann_json_j, const Type& nlohmann_json_t)      \
    {                                                                            \
        NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__)) \
    }
TO_JSON(DeviceFacts, name, platform, driver, opencl, opencl_c, kind, compute_units,
        global_memory_bytes, max_allocation_bytes, local_memory_bytes, max_group_size,
        timer_resolution_ns, correctly_rounded_division, device_scope_acq_rel_atomics)
TO_JSON(SweptFacts, pairs, to_frame, primitives)
TO_JSON(NodeCosts, inner, triangle)
TO_JSON(Outlier, of, triangle, diameters)
TO_JSON(FirstRun, compile_ns, run_ns)
#undef TO_JSON

namespace {

Json json_of(const SceneFacts& scene)
{
    Json json = {{"name", scene.name}};
    put_if(json, "objects_by", scene.objects_by);
    if (scene.between > 0)
        json["between"] = scene.between;
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
        json["content_hash"] = hex(scene.content_hash);
    }
    return json;
}

Json json_of(const BuilderChoice& builder)
{
    return {{"name", builder.name},
            {"options", choices_json({.builder = builder}, Choice::Of::builder)}};
}

Json json_of(const ColliderChoice& collider)
{
    Json options = choices_json({.collider = collider}, Choice::Of::query);
    options.update(choices_json({.collider = collider}, Choice::Of::collider));
    return {{"name", collider.name}, {"options", std::move(options)}};
}

Json json_of(const AccuracyFacts& accuracy)
{
    Json json = {{"axis", accuracy.axis}, {"method", accuracy.method}};
    if (accuracy.seed > 0)
        json["seed"] = accuracy.seed;
    return json;
}

Json json_of(const Check& check)
{
    constexpr std::array verdicts = {"agrees", "differs", "not_checked", "counted"};
    Json json = {{"verdict", verdicts[static_cast<std::size_t>(check.verdict)]}};
    put_if(json, "against", check.against);
    put_if(json, "detail", check.detail);
    if (check.tree_hash)
        json["tree_hash"] = hex(*check.tree_hash);
    if (check.pairs_hash)
        json["pairs_hash"] = hex(*check.pairs_hash);
    if (check.contacts_hash)
        json["contacts_hash"] = hex(*check.contacts_hash);
    return json;
}

Json json_of(const SamplingFacts& sampling)
{
    Json json = {{"stopped", stopped_name(sampling.stopped)},
                 {"caches", sampling.cold ? "cold" : "hot"}};
    if (sampling.until > 0)
        json["until"] = sampling.until;
    put_if(json, "race", std::string(race_name(sampling.race)));
    return json;
}

Json json_of(const HostConditions& conditions)
{
    Json json = Json::object();
    put_if(json, "governor", conditions.governor);
    if (conditions.turbo)
        json["turbo"] = *conditions.turbo;
    if (conditions.on_battery)
        json["on_battery"] = *conditions.on_battery;
    if (conditions.load)
        json["load"] = *conditions.load;
    json["warnings"] = conditions.warnings;
    return json;
}

/// Replaces invalid UTF-8, which file names and logs may contain and result files must not.
std::string dumped(const Json& json)
{
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string run_text(const RunFacts& run)
{
    Json json = {{"id", run.id}, {"started_at", run.started_at}, {"command", run.command}};
    json["program"] = {{"version", run.version},   {"commit", run.commit},
                       {"dirty", run.dirty},       {"build_type", run.build_type},
                       {"compiler", run.compiler}, {"arch", run.arch},
                       {"kernels", run.kernels}};
    json["host"] = {{"name", run.host_name},
                    {"cpu", run.host_cpu},
                    {"threads", run.host_threads},
                    {"os", run.host_os}};
    json["device"] = run.device;
    json["libraries"] = run.libraries;
    if (std::isfinite(run.copy_rate_bytes_per_s) && run.copy_rate_bytes_per_s > 0) {
        json["copy_rate_bytes_per_s"] = run.copy_rate_bytes_per_s;
        json["copy_rate_buffer_bytes"] = run.copy_rate_buffer_bytes;
    }
    if (std::isfinite(run.launch_cost_ns) && run.launch_cost_ns > 0)
        json["launch_cost_ns"] = run.launch_cost_ns;
    json["tuning"] = {{"from", run.tuning_from}, {"values", run.tuning}};
    json["compile_ns"] = run.compile_ns;
    json["node_costs"] = run.costs;
    if (run.conditions != HostConditions{})
        json["conditions"] = json_of(run.conditions);
    if (!run.test_hooks.empty())
        json["test_hooks"] = run.test_hooks;
    return dumped(json);
}

std::string cell_text(const Cell& cell)
{
    constexpr std::array states = {"measured", "skipped", "failed"};
    Json json = {{"experiment", cell.experiment},
                 {"scene", json_of(cell.scene)},
                 {"builder", json_of(cell.builder)}};
    if (!cell.collider.name.empty())
        json["collider"] = json_of(cell.collider);
    if (!cell.swept.pairs.empty())
        json["swept"] = cell.swept;
    if (!cell.accuracy.axis.empty())
        json["accuracy"] = json_of(cell.accuracy);
    json["operation"] = operation_name(cell.operation);
    json["status"] = states[static_cast<std::size_t>(cell.status)];
    if (cell.status != Cell::Status::measured) {
        json["reason"] = cell.reason;
        return dumped(json);
    }
    json["warm_up"] = cell.warm_up;
    if (cell.first.run_ns > 0)
        json["first"] = cell.first;
    if (cell.sampling.stopped != Stopped::not_sampled)
        json["sampling"] = json_of(cell.sampling);
    json["samples"] = cell.samples;
    Json& counters = json["counters"] = Json::object();
    for (const auto& [key, value] : cell.counters) {
        const bool is_whole = value == std::floor(value) && std::fabs(value) < 0x1p53;
        if (std::isfinite(value))
            counters[key] = is_whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
    }
    if (!cell.left_out.empty())
        json["left_out"] = cell.left_out;
    if (!cell.leaves_by_depth.empty())
        json["leaves_by_depth"] = cell.leaves_by_depth;
    json["check"] = json_of(cell.check);
    return dumped(json);
}

std::string cell_text(const StressCell& cell)
{
    Json json = {{"family", cell.family}, {"scene", cell.scene}};
    if (cell.triangles > 0)
        json["triangles"] = cell.triangles;
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
    return dumped(json);
}

std::string document_text(const std::string& run, const std::vector<std::string>& cells,
                          const std::vector<std::string>& stress)
{
    const auto lines = [](const std::vector<std::string>& all) {
        std::string text;
        for (std::size_t i = 0; i < all.size(); ++i)
            text += (i == 0 ? "\n" : ",\n") + all[i];
        return text;
    };
    std::string text = "{\"format\": \"" + result_format + "\",\n\"run\": " + run;
    text += ",\n\"cells\": [" + lines(cells) + "\n]";
    if (!stress.empty())
        text += ",\n\"stress\": [" + lines(stress) + "\n]";
    return text + "}\n";
}

}  // namespace bvhbench
