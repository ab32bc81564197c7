// SPDX-License-Identifier: MIT
#include <iostream>

#include "builders/box_format.h"
#include "builders/orders.h"
#include "collide/narrow/narrow_methods.h"
#include "collide/skips.h"
#include "geometry/error.h"
#include "harness/accuracy/axis.h"
#include "harness/base/table.h"
#include "harness/choice/experiment.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/record/provenance.h"
#include "harness/session/pocl_cache.h"
#include "harness/session/session.h"
#include "harness/session/tuning_file.h"

namespace bvhbench {
namespace {

using enum Table::Align;

/// A line an entry, the name first and no title, so that scripts can read it.
Table lines(std::size_t columns) { return Table(std::vector<Table::Column>(columns, {"", left})); }

std::string builders(const CommonOptions&)
{
    Table table = lines(2);
    for (const BuilderEntry& entry : builder_catalog())
        table.row({std::string(entry.name),
                   std::string(entry.make != nullptr ? entry.summary : entry.absent)});
    return table.text();
}

std::string colliders(const CommonOptions&)
{
    Table table = lines(2);
    for (const ColliderEntry& entry : collider_catalog())
        table.row({std::string(entry.name),
                   std::string(entry.make != nullptr ? entry.summary : entry.absent)});
    return table.text();
}

std::string narrow(const CommonOptions&)
{
    Table table = lines(2);
    for (const NarrowMethod& method : narrow_methods())
        table.row({std::string(method.name), std::string(method.summary)});
    return table.text();
}

std::string accuracy(const CommonOptions&)
{
    Table table = lines(2);
    for (const Axis& axis : accuracy_axes())
        table.row({std::string(axis.name), std::string(axis.question)});
    return table.text();
}

std::string skips(const CommonOptions&)
{
    Table table = lines(2);
    for (const SkipRuleEntry& entry : skip_rules())
        table.row({std::string(entry.name), std::string(entry.summary)});
    return table.text();
}

std::string orders(const CommonOptions&)
{
    Table table = lines(3);
    for (const OrderEntry& entry : order_catalog())
        table.row({std::string(entry.name),
                   entry.code_bits > 0 ? std::to_string(entry.code_bits) + " bits" : "no codes",
                   std::string(entry.summary)});
    return table.text();
}

std::string formats(const CommonOptions&)
{
    Table table = lines(3);
    for (const BoxFormat& format : box_formats())
        table.row({std::string(format.name), std::to_string(format.box_bytes()) + " bytes a box",
                   std::string(format.summary)});
    return table.text();
}

std::string scenes(const CommonOptions& common)
{
    Table table = lines(2);
    for (const SceneListing& listing : list_scenes(scene_library(common)))
        table.row({listing.name, listing.summary});
    return table.text();
}

std::string experiments(const CommonOptions&)
{
    Table table = lines(3);
    for (const std::string_view name : experiment_names()) {
        const Experiment experiment = find_experiment(std::string(name), false);
        table.row({experiment.name, experiment.paper, experiment.question});
    }
    return table.text();
}

/// What parameters are on the device, and where that comes from.
std::string tuning(const CommonOptions& common)
{
    const PoclCache cache;
    const Device device = open_device_of(common);
    Table table = lines(6);
    for (const Parameter* parameter : tuning_parameters()) {
        std::string candidates;
        for (const uint value : parameter->candidates)
            candidates += (candidates.empty() ? "" : " ") + std::to_string(value);
        table.row({std::string(parameter->name), std::to_string(device.tuned(*parameter)),
                   device.tuning.has(*parameter) ? device.tuning.origin() : "default",
                   "of " + candidates,
                   parameter->stage.empty() ? "all stages" : std::string(parameter->stage),
                   std::string(parameter->meaning)});
    }
    return table.text();
}

/// What the program branches on or reports, of every device.
std::string devices(const CommonOptions&)
{
    const PoclCache cache;
    const std::size_t count = device_names().size();
    if (count == 0)
        throw Unavailable("there is no OpenCL device");
    Table table = lines(11);
    const auto bytes = [](std::int64_t value) { return bytes_text(static_cast<double>(value)); };
    for (std::size_t i = 0; i < count; ++i) {
        const DeviceFacts facts = device_facts(open_device(std::to_string(i)));
        table.row({facts.platform + '/' + facts.name, "index " + std::to_string(i), facts.kind,
                   "driver " + facts.driver, facts.opencl_c,
                   std::to_string(facts.compute_units) + " units", bytes(facts.global_memory_bytes),
                   bytes(facts.local_memory_bytes) + " local",
                   "groups to " + std::to_string(facts.max_group_size),
                   duration_text(static_cast<double>(facts.timer_resolution_ns)) + " timer",
                   std::string(facts.correctly_rounded_division ? "exact division"
                                                                : "division to 2.5 ulp") +
                       (facts.device_scope_acq_rel_atomics ? ", acq_rel atomics" : "")});
    }
    return table.text();
}

/// What there are lists of.
constexpr std::pair<std::string_view, std::string (*)(const CommonOptions&)> lists[] = {
    {"builders", builders}, {"colliders", colliders},    {"narrow", narrow},
    {"orders", orders},     {"formats", formats},        {"skips", skips},
    {"tuning", tuning},     {"scenes", scenes},          {"devices", devices},
    {"accuracy", accuracy}, {"experiments", experiments}};

class List final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        std::vector<std::string> names;
        for (const auto& [name, text] : lists)
            names.emplace_back(name);
        app.add_option("WHAT", what_,
                       "builders, colliders, narrow, orders, formats, skips, tuning, scenes, "
                       "devices, accuracy or "
                       "experiments")
            ->required()
            ->check(one_of(names));
    }

    int run(const Invocation& invocation) override
    {
        for (const auto& [name, text] : lists)
            if (name == what_)
                std::cout << text(invocation.common);
        return 0;
    }

private:
    std::string what_;
};

}  // namespace

extern const CommandEntry list_command = {
    "list",
    knowing,
    "What there is, a line each",
    "Names are what other commands take. A line that says 'built without' names a library that "
    "this build lacks.",
    {{"bvhbench list builders", "names, and what each is"},
     {"bvhbench list devices", "for --device: words of a name, or its index"},
     {"bvhbench list scenes", "generators and data sets, and which of those are there"}},
    "docs/adding.md",
    make_command<List>};

}  // namespace bvhbench
