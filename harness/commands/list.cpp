// SPDX-License-Identifier: MIT
#include <functional>
#include <iostream>

#include "builders/box_format.h"
#include "builders/orders.h"
#include "collide/narrow/narrow_methods.h"
#include "collide/skips.h"
#include "geometry/names.h"
#include "harness/accuracy/axis.h"
#include "harness/base/table.h"
#include "harness/base/terminal.h"
#include "harness/choice/experiment.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/record/provenance.h"
#include "harness/session/pocl_cache.h"
#include "harness/session/session.h"
#include "harness/session/tuning_file.h"

namespace bvhbench {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Returns a row for each entry, with its name first.
template <class Entries, class... Column>
Rows rows(const Entries& entries, const Column&... columns)
{
    Rows all;
    for (const auto& entry : entries)
        all.push_back({std::string(columns(entry))...});
    return all;
}

constexpr auto name = [](const auto& entry) { return entry.name; };
constexpr auto summary = [](const auto& entry) { return entry.summary; };
constexpr auto summary_or_why_not = [](const auto& entry) {
    return entry.is_there() ? entry.summary : entry.absent;
};
constexpr auto question = [](const auto& entry) { return entry.question; };

Rows builders(const CommonOptions&)
{
    const auto order = [](const BuilderEntry& one) {
        return one.own_order ? "own order" : "any order";
    };
    return rows(builder_catalog(), name, order, summary_or_why_not);
}

Rows scenes(const CommonOptions& common)
{
    return rows(list_scenes(scene_library(common)), name, summary);
}

Rows orders(const CommonOptions&)
{
    const auto bits = [](const OrderEntry& entry) {
        return entry.code_bits > 0 ? std::to_string(entry.code_bits) + " bits" : "no codes";
    };
    return rows(order_catalog(), name, bits, summary);
}

Rows formats(const CommonOptions&)
{
    const auto bytes = [](const BoxFormat& format) {
        return std::to_string(format.box_bytes()) + " bytes a box";
    };
    return rows(box_formats(), name, bytes, summary);
}

/// Says of each rule where it is used, if that is not everywhere.
Rows skips(const CommonOptions&)
{
    const auto use = [](const std::string& where, std::size_t from) {
        return from == always  ? ""
               : from == never ? "not on " + where
                               : "on " + where + " from " + std::to_string(from) + " triangles";
    };
    const auto both = [&](const SkipRuleEntry& entry) {
        const std::string cpu = use("CPUs", entry.on_cpu_from),
                          gpu = use("GPUs", entry.on_gpu_from);
        return std::min(entry.on_cpu_from, entry.on_gpu_from) == never ? "where forced"
               : cpu.empty() && gpu.empty()                            ? "on"
                                            : cpu + (cpu.empty() || gpu.empty() ? "" : ", ") + gpu;
    };
    return rows(skip_rules(), name, both, summary);
}

Rows experiments(const CommonOptions&)
{
    std::vector<Experiment> all;
    for (const std::string_view one : experiment_names())
        all.push_back(find_experiment(std::string(one), false));
    return rows(all, name, std::mem_fn(&Experiment::paper), question);
}

/// Returns the values of all tuning parameters on the device and their origins.
Rows tuning(const CommonOptions& common)
{
    const PoclCache cache;
    const Device device = open_device_of(common);
    Rows all;
    for (const Parameter* parameter : tuning_parameters()) {
        std::string candidates = "of";
        for (const uint value : parameter->candidates)
            candidates += ' ' + std::to_string(value);
        all.push_back({std::string(parameter->name), std::to_string(device.tuned(*parameter)),
                       device.tuning.has(*parameter) ? device.tuning.origin() : "default",
                       candidates,
                       parameter->stage.empty() ? "all stages" : std::string(parameter->stage),
                       std::string(parameter->meaning)});
    }
    return all;
}

/// Returns the properties of all devices that the program depends on or reports.
Rows devices(const CommonOptions&)
{
    const PoclCache cache;
    const std::size_t count = device_names().size();
    if (count == 0)
        throw Unavailable("there is no OpenCL device");
    Rows all;
    for (std::size_t i = 0; i < count; ++i) {
        const Json facts = device_facts(open_device(std::to_string(i)));
        const auto text = [&](const char* key) { return facts[key].get<std::string>(); };
        const auto bytes = [&](const char* key) { return bytes_text(facts[key].get<double>()); };
        all.push_back(
            {text("platform") + '/' + text("name"), "index " + std::to_string(i), text("kind"),
             "driver " + text("driver"), text("opencl_c"), facts["compute_units"].dump() + " units",
             bytes("global_memory_bytes"), bytes("local_memory_bytes") + " local",
             "groups to " + facts["max_group_size"].dump(),
             duration_text(facts["timer_resolution_ns"].get<double>()) + " timer",
             std::string(facts["correctly_rounded_division"].get<bool>() ? "exact division"
                                                                         : "division to 2.5 ulp") +
                 (facts["device_scope_acq_rel_atomics"].get<bool>() ? ", acq_rel atomics" : "")});
    }
    return all;
}

struct ListEntry {
    std::string_view name, summary;
    Rows (*entries)(const CommonOptions&);
};

constexpr ListEntry lists[] = {
    {"builders", "what makes trees, of leaves in any order or in one of its own", builders},
    {"colliders", "what finds pairs of boxes",
     [](const CommonOptions&) { return rows(collider_catalog(), name, summary_or_why_not); }},
    {"narrow", "which of these pairs touch",
     [](const CommonOptions&) { return rows(narrow_methods(), name, summary); }},
    {"orders", "of leaves", orders},
    {"formats", "of boxes", formats},
    {"skips", "rules that leave out work", skips},
    {"tuning", "parameters of kernels, as they are on this device", tuning},
    {"scenes", "generators and data sets", scenes},
    {"devices", "of OpenCL", devices},
    {"accuracy", "what `bvhbench accuracy` measures",
     [](const CommonOptions&) { return rows(accuracy_axes(), name, question); }},
    {"experiments", "what `bvhbench run` measures", experiments}};

class List final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_option_function<std::string>(
            "WHAT", [this](const std::string& word) { list_ = &find_called(lists, word, "list"); },
            joined(names_of(lists)));
        app.add_flag("--json", is_json_, "print JSON: a list of texts a line");
    }

    int run(const Invocation& invocation) override
    {
        const CommonOptions& common = invocation.common;
        const Rows all = list_ == nullptr ? rows(lists, name, summary) : list_->entries(common);
        Table table(std::vector<std::string>(all.front().size(), "<"));
        for (const std::vector<std::string>& row : all)
            table.row(row);
        std::cout << (is_json_ ? Json(all).dump(1) + '\n'
                               : table.text(common.wide ? 0 : terminal_width()));
        return has_broken_outside() ? 3 : 0;
    }

private:
    const ListEntry* list_ = nullptr;
    bool is_json_ = false;
};

}  // namespace

extern const CommandEntry list_command = {
    "list",
    knowing,
    "What there is, a line each",
    "Without a word: what lists there are. Names are what other commands take. A line that says "
    "'built without' names a library that this build lacks.",
    {{"bvhbench list builders", "names, and what each is"},
     {"bvhbench list builders --json", "the same for scripts"},
     {"bvhbench list devices", "for --device: words of a name, or its index"},
     {"bvhbench list scenes", "generators and data sets, and which of those are there"}},
    "docs/commands.md",
    make_command<List>};

}  // namespace bvhbench
