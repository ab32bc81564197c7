// SPDX-License-Identifier: MIT
//
// Reading result files back. Keys it does not know are left alone: a newer minor format may add some.
#include <charconv>
#include <nlohmann/json.hpp>

#include "geometry/error.h"
#include "harness/json_reason.h"
#include "harness/record.h"

namespace bvhbench {
namespace {

using Json = nlohmann::json;

template <class T>
T get(const Json& json, const char* key)
{
    return json.value(key, T{});
}

std::uint64_t hash_of(const std::string& text)
{
    return text.empty() ? 0 : std::stoull(text, nullptr, 16);
}

std::size_t index_of(const std::string& word, std::initializer_list<const char*> words)
{
    std::size_t index = 0;
    for (const char* known : words) {
        if (word == known)
            return index;
        ++index;
    }
    throw std::invalid_argument("'" + word + "' is not a word it may hold");
}

StageTime stage_of(const Json& json)
{
    return {.stage = json.at("stage").get<std::string>(),
            .busy_ns = get<std::int64_t>(json, "busy_ns"),
            .span_ns = get<std::int64_t>(json, "span_ns"),
            .wall_ns = get<std::int64_t>(json, "wall_ns"),
            .launches = get<int>(json, "launches"),
            .moved_bytes = get<std::int64_t>(json, "moved_bytes"),
            .start_ns = get<std::int64_t>(json, "start_ns"),
            .queued_ns = get<std::int64_t>(json, "queued_ns"),
            .submitted_ns = get<std::int64_t>(json, "submitted_ns")};
}

Sample sample_of(const Json& json)
{
    Sample sample{.order = json.at("order").get<int>(),
                  .stages = {},
                  .calibration_ns = get<std::int64_t>(json, "calibration_ns"),
                  .drifted = get<bool>(json, "drifted")};
    for (const Json& stage : json.at("stages"))
        sample.stages.push_back(stage_of(stage));
    return sample;
}

Outlier outlier_of(const Json& json)
{
    return {.of = get<std::string>(json, "of"),
            .triangle = get<uint>(json, "triangle"),
            .diameters = get<double>(json, "diameters")};
}

Rounding rounding_of(const Json& json)
{
    if (json.empty())
        return {};
    const Json& offset = json.at("offset");
    return {.how = doubles_called(json.at("how").get<std::string>()),
            .offset = {offset.at(0), offset.at(1), offset.at(2)},
            .scale_log2 = get<int>(json, "scale_log2"),
            .rounded_count = get<std::uint64_t>(json, "rounded_count"),
            .largest_error = get<double>(json, "largest_error")};
}

SceneFacts scene_of(const Json& json)
{
    return {.name = json.at("name").get<std::string>(),
            .objects_by = get<std::string>(json, "objects_by"),
            .between = get<std::int64_t>(json, "between"),
            .triangles = get<std::int64_t>(json, "triangles"),
            .vertices = get<std::int64_t>(json, "vertices"),
            .objects = get<std::int64_t>(json, "objects"),
            .frame = get<std::int64_t>(json, "frame"),
            .source = get<std::string>(json, "source"),
            .stand_in_for = get<std::string>(json, "stand_in_for"),
            .outlier = outlier_of(json.value("outlier", Json::object())),
            .rounding = rounding_of(json.value("doubles", Json::object())),
            .bend_of = get<std::string>(json, "bend_of"),
            .content_hash = hash_of(get<std::string>(json, "content_hash"))};
}

BuilderChoice builder_of(const Json& json)
{
    const Json options = json.value("options", Json::object());
    return {.name = json.at("name").get<std::string>(),
            .order = options.value("order", "morton30"),
            .grid = options.value("grid", "object") == "scene" ? GridOver::scene : GridOver::object,
            .group_size = get<unsigned>(options, "group_size"),
            .items = get<unsigned>(options, "items"),
            .sorted_leaves = options.value("leaves", "mesh") == "sorted",
            .boxes = options.value("boxes", "f32")};
}

/// The rules of "rigid, apart". Names of later formats are passed over.
unsigned rules_of(const std::string& text)
{
    unsigned rules = 0;
    for (const SkipRuleEntry& entry : skip_rules())
        if ((", " + text + ", ").find(", " + std::string(entry.name) + ", ") != text.npos)
            rules |= entry.rule;
    return rules;
}

ColliderChoice collider_of(const Json& json)
{
    const Json options = json.value("options", Json::object());
    return {.name = json.at("name").get<std::string>(),
            .among = among_called(options.value("pairs_of", "all")),
            .keep_adjacent = options.value("adjacent", "keep") == "keep",
            .narrow = options.value("narrow", "none"),
            .jump = get<unsigned>(options, "jump"),
            .start_level = get<unsigned>(options, "start_level"),
            .group_size = get<unsigned>(options, "group_size"),
            .rules_off = rules_of(get<std::string>(options, "no_skip"))};
}

SweptFacts swept_of(const Json& json)
{
    return {.pairs = json.at("pairs").get<std::string>(),
            .to_frame = get<std::int64_t>(json, "to_frame"),
            .primitives = get<std::int64_t>(json, "primitives")};
}

AccuracyFacts accuracy_of(const Json& json)
{
    return {.axis = json.at("axis").get<std::string>(),
            .method = json.at("method").get<std::string>(),
            .seed = get<std::int64_t>(json, "seed")};
}

SamplingFacts sampling_of(const Json& json)
{
    return {.stopped = static_cast<Stopped>(index_of(
                json.at("stopped").get<std::string>(),
                {"not_sampled", "number", "steady", "noisy", "most", "budget", "failure"})),
            .until = get<double>(json, "until"),
            .cold = json.value("caches", "hot") == "cold"};
}

HostConditions conditions_of(const Json& json)
{
    HostConditions conditions;
    conditions.governor = get<std::string>(json, "governor");
    if (json.contains("turbo"))
        conditions.turbo = json["turbo"].get<bool>();
    if (json.contains("on_battery"))
        conditions.on_battery = json["on_battery"].get<bool>();
    if (json.contains("load"))
        conditions.load = json["load"].get<double>();
    conditions.warnings = get<std::vector<std::string>>(json, "warnings");
    return conditions;
}

Check check_of(const Json& json)
{
    Check check;
    check.verdict = static_cast<Check::Verdict>(index_of(
        json.at("verdict").get<std::string>(), {"agrees", "differs", "not_checked", "counted"}));
    check.against = get<std::string>(json, "against");
    check.detail = get<std::string>(json, "detail");
    if (json.contains("tree_hash"))
        check.tree_hash = hash_of(json["tree_hash"].get<std::string>());
    if (json.contains("pairs_hash"))
        check.pairs_hash = hash_of(json["pairs_hash"].get<std::string>());
    if (json.contains("contacts_hash"))
        check.contacts_hash = hash_of(json["contacts_hash"].get<std::string>());
    return check;
}

Cell cell_of(const Json& json)
{
    Cell cell;
    cell.experiment = json.at("experiment").get<std::string>();
    cell.scene = scene_of(json.at("scene"));
    cell.builder = builder_of(json.at("builder"));
    if (json.contains("collider"))
        cell.collider = collider_of(json["collider"]);
    if (json.contains("swept"))
        cell.swept = swept_of(json["swept"]);
    if (json.contains("accuracy"))
        cell.accuracy = accuracy_of(json["accuracy"]);
    cell.operation = static_cast<Operation>(
        index_of(json.value("operation", "build"),
                 {"build", "refit", "collide", "accuracy"}));  // before 1.2 all were builds
    cell.status = static_cast<Cell::Status>(
        index_of(json.at("status").get<std::string>(), {"measured", "skipped", "failed"}));
    cell.run = get<std::string>(json, "run");
    cell.reason = get<std::string>(json, "reason");
    cell.warm_up = get<int>(json, "warm_up");
    if (json.contains("first"))  // this and the next since 1.8
        cell.first = {.compile_ns = get<std::int64_t>(json["first"], "compile_ns"),
                      .run_ns = get<std::int64_t>(json["first"], "run_ns")};
    if (json.contains("sampling"))
        cell.sampling = sampling_of(json["sampling"]);
    for (const Json& sample : json.value("samples", Json::array()))
        cell.samples.push_back(sample_of(sample));
    cell.counters = json.value("counters", std::map<std::string, double>{});
    cell.left_out = json.value("left_out", std::map<std::string, std::string>{});
    cell.leaves_by_depth = json.value("leaves_by_depth", std::vector<std::int64_t>{});
    if (json.contains("check"))
        cell.check = check_of(json["check"]);
    return cell;
}

template <std::size_t N>
std::size_t index_of(const std::string& word, const std::array<const char*, N>& words)
{
    for (std::size_t index = 0; index < N; ++index)
        if (word == words[index])
            return index;
    throw std::invalid_argument("'" + word + "' is not a word it may hold");
}

StressCell stress_cell_of(const Json& json)
{
    StressCell cell;
    cell.family = json.at("family").get<std::string>();
    cell.scene = json.at("scene").get<std::string>();
    cell.triangles = get<std::int64_t>(json, "triangles");
    cell.system = json.at("system").get<std::string>();
    cell.kind = static_cast<StressCell::Kind>(
        index_of(json.at("kind").get<std::string>(), stress_kind_names));
    cell.library = get<std::string>(json, "library");
    for (const auto& [name, finding] : json.at("findings").items())
        cell.findings[static_cast<Invariant>(index_of(name, invariant_names))] = {
            .verdict = static_cast<Finding::Verdict>(
                index_of(finding.at("verdict").get<std::string>(), stress_verdict_names)),
            .checked = get<std::uint64_t>(finding, "checked"),
            .wrong = get<std::uint64_t>(finding, "wrong"),
            .missed = get<std::uint64_t>(finding, "missed"),
            .detail = get<std::string>(finding, "detail")};
    return cell;
}

DeviceFacts device_of(const Json& json)
{
    return {.name = json.at("name").get<std::string>(),
            .platform = get<std::string>(json, "platform"),
            .driver = get<std::string>(json, "driver"),
            .opencl = get<std::string>(json, "opencl"),
            .opencl_c = get<std::string>(json, "opencl_c"),
            .kind = get<std::string>(json, "kind"),
            .compute_units = get<std::int64_t>(json, "compute_units"),
            .global_memory_bytes = get<std::int64_t>(json, "global_memory_bytes"),
            .max_allocation_bytes = get<std::int64_t>(json, "max_allocation_bytes"),
            .local_memory_bytes = get<std::int64_t>(json, "local_memory_bytes"),
            .max_group_size = get<std::int64_t>(json, "max_group_size"),
            .timer_resolution_ns = get<std::int64_t>(json, "timer_resolution_ns"),
            .correctly_rounded_division = get<bool>(json, "correctly_rounded_division"),
            .device_scope_acq_rel_atomics = get<bool>(json, "device_scope_acq_rel_atomics")};
}

RunFacts run_of(const Json& json)
{
    RunFacts run;
    run.id = json.at("id").get<std::string>();
    run.started_at = json.at("started_at").get<std::string>();
    run.finished_at = get<std::string>(json, "finished_at");
    run.command = get<std::vector<std::string>>(json, "command");
    const Json& program = json.at("program");
    run.version = get<std::string>(program, "version");
    run.commit = get<std::string>(program, "commit");
    run.dirty = get<bool>(program, "dirty");
    run.build_type = get<std::string>(program, "build_type");
    run.compiler = get<std::string>(program, "compiler");
    run.arch = get<std::string>(program, "arch");
    run.kernels = get<std::string>(program, "kernels");
    const Json& host = json.at("host");
    run.host_name = get<std::string>(host, "name");
    run.host_cpu = get<std::string>(host, "cpu");
    run.host_os = get<std::string>(host, "os");
    run.host_threads = get<int>(host, "threads");
    run.device = device_of(json.at("device"));
    run.libraries = get<std::map<std::string, std::string>>(json, "libraries");
    run.copy_rate_bytes_per_s = get<double>(json, "copy_rate_bytes_per_s");
    run.copy_rate_buffer_bytes = get<std::int64_t>(json, "copy_rate_buffer_bytes");
    run.launch_cost_ns = get<double>(json, "launch_cost_ns");
    const Json tuning = json.value("tuning", Json::object());
    run.tuning_from = tuning.value("from", "none");
    run.tuning = tuning.value("values", std::map<std::string, uint>{});
    run.compile_ns = get<std::int64_t>(json, "compile_ns");
    if (json.contains("node_costs"))  // before format 1.2 there were only the usual ones
        run.costs = {.inner = json["node_costs"].at("inner").get<double>(),
                     .triangle = json["node_costs"].at("triangle").get<double>()};
    run.conditions = conditions_of(json.value("conditions", Json::object()));
    const Json memory = json.value("host_memory", Json::object());  // since 1.9
    run.memory = {.given = get<std::uint64_t>(memory, "given_bytes"),
                  .predicted = get<std::uint64_t>(memory, "predicted_bytes"),
                  .peak = get<std::uint64_t>(memory, "peak_bytes")};
    run.turns_with = get<std::vector<std::string>>(json, "turns_with");
    run.test_hooks = get<std::map<std::string, std::string>>(json, "test_hooks");
    return run;
}

SourceRun source_of(const Json& json)
{
    return {.id = json.at("id").get<std::string>(),
            .started_at = get<std::string>(json, "started_at"),
            .finished_at = get<std::string>(json, "finished_at"),
            .commit = get<std::string>(json, "commit"),
            .host = get<std::string>(json, "host"),
            .device = get<std::string>(json, "device"),
            .driver = get<std::string>(json, "driver"),
            .dirty = get<bool>(json, "dirty"),
            .copy_rate_bytes_per_s = get<double>(json, "copy_rate_bytes_per_s")};
}

/// Of "1.9".
int minor_of(const std::string& format)
{
    int minor = 0;
    const char* end = format.data() + format.size();
    const auto read = std::from_chars(format.data() + 2, end, minor);
    if (read.ec != std::errc() || read.ptr != end)
        throw std::invalid_argument("'" + format + "' is no format");
    return minor;
}

}  // namespace

Document read_document(const std::string& text, const std::string& origin)
{
    try {
        const Json json = Json::parse(text);
        const std::string format = json.at("format").get<std::string>();
        if (!format.starts_with("1."))
            throw Unavailable(origin + " has format " + format + "; this program reads 1.x");
        Document document{run_of(json.at("run")), {}};
        for (const Json& cell : json.at("cells"))
            document.cells.push_back(cell_of(cell));
        for (const Json& cell : json.value("stress", Json::array()))  // since 1.6
            document.stress.push_back(stress_cell_of(cell));
        for (const Json& source : json.value("merged_from", Json::array()))  // since 1.8
            document.merged_from.push_back(source_of(source));
        document.minor = minor_of(format);
        return document;
    } catch (const Json::exception& error) {
        throw Unavailable(origin + " is no result file: " + json_reason(error));
    } catch (const std::logic_error& error) {  // a number or word that is none
        throw Unavailable(origin + " is no result file: " + error.what());
    }
}

}  // namespace bvhbench
