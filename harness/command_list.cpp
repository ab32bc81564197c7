// SPDX-License-Identifier: MIT
#include <iostream>

#include "builders/box_format.h"
#include "builders/orders.h"
#include "collide/narrow_methods.h"
#include "geometry/error.h"
#include "harness/accuracy/axis.h"
#include "harness/commands.h"
#include "harness/experiment.h"
#include "harness/pocl_cache.h"
#include "harness/provenance.h"
#include "harness/session.h"
#include "harness/table.h"
#include "harness/tuning_file.h"

namespace bvhbench {
namespace {

using enum Table::Align;

/// A line an entry, the name first and no title, so that scripts can read it.
Table lines(std::size_t columns) { return Table(std::vector<Table::Column>(columns, {"", left})); }

std::string builders()
{
    Table table = lines(2);
    for (const BuilderEntry& entry : builder_catalog())
        table.row({std::string(entry.name),
                   std::string(entry.make != nullptr ? entry.summary : entry.absent)});
    return table.text();
}

std::string colliders()
{
    Table table = lines(2);
    for (const ColliderEntry& entry : collider_catalog())
        table.row({std::string(entry.name),
                   std::string(entry.make != nullptr ? entry.summary : entry.absent)});
    return table.text();
}

std::string narrow()
{
    Table table = lines(2);
    for (const NarrowMethod& method : narrow_methods())
        table.row({std::string(method.name), std::string(method.summary)});
    return table.text();
}

std::string accuracy()
{
    Table table = lines(2);
    for (const Axis& axis : accuracy_axes())
        table.row({std::string(axis.name), std::string(axis.question)});
    return table.text();
}

std::string skips()
{
    Table table = lines(2);
    for (const SkipRuleEntry& entry : skip_rules())
        table.row({std::string(entry.name), std::string(entry.summary)});
    return table.text();
}

std::string orders()
{
    Table table = lines(3);
    for (const OrderEntry& entry : order_catalog())
        table.row({std::string(entry.name),
                   entry.code_bits > 0 ? std::to_string(entry.code_bits) + " bits" : "no codes",
                   std::string(entry.summary)});
    return table.text();
}

std::string formats()
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

std::string experiments()
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
std::string devices()
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

}  // namespace

int list(const ListCommand& command, const Options& options)
{
    std::cout << (command.what == "builders"    ? builders()
                  : command.what == "colliders" ? colliders()
                  : command.what == "orders"    ? orders()
                  : command.what == "formats"   ? formats()
                  : command.what == "narrow"    ? narrow()
                  : command.what == "accuracy"  ? accuracy()
                  : command.what == "skips"     ? skips()
                  : command.what == "tuning"    ? tuning(options.common)
                  : command.what == "scenes"    ? scenes(options.common)
                  : command.what == "devices"   ? devices()
                                                : experiments());
    return 0;
}

}  // namespace bvhbench
