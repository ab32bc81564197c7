// SPDX-License-Identifier: MIT
#include <iostream>

#include "collide/narrow/narrow_methods.h"
#include "harness/base/python.h"
#include "harness/base/table.h"
#include "harness/measure/run.h"
#include "harness/record/provenance.h"

namespace bvhbench {
namespace {

/// Returns the experiment smoke with one sample of each cell and with every narrow phase.
Experiment portable_experiment()
{
    Experiment experiment = find_experiment("smoke", false);
    experiment.name = "portable";
    experiment.samples = 1;
    experiment.warm_up = 0;
    for (CollideTask& task : experiment.collisions) {
        task.samples = 1;
        task.warm_up = 0;
        PipelineChoice pipeline = task.pipelines.front();
        for (const NarrowMethod& method : narrow_methods()) {
            pipeline.collider.narrow = method.name;
            if (pipeline != task.pipelines.front())
                task.pipelines.push_back(pipeline);
        }
    }
    return experiment;
}

std::string device_text(const Device& device)
{
    const DeviceFacts facts = device_facts(device);
    using enum Table::Align;
    Table table({{"", left}, {"", left}});
    const auto number = [](std::int64_t value) { return std::to_string(value); };
    table.row({"device", facts.name});
    table.row({"platform", facts.platform});
    table.row({"driver", facts.driver});
    table.row({"OpenCL", facts.opencl + ", " + facts.opencl_c});
    table.row({"kind", facts.kind + " of " + number(facts.compute_units) + " units"});
    table.row({"memory", number(facts.global_memory_bytes) + " bytes, " +
                             number(facts.max_allocation_bytes) + " in one piece, " +
                             number(facts.local_memory_bytes) + " local"});
    table.row({"groups", "to " + number(facts.max_group_size) + " work-items"});
    table.row({"loops", device.ends_loops ? "end after 65,535 steps" : "end by themselves"});
    table.row({"extensions", device.cl.getInfo<CL_DEVICE_EXTENSIONS>()});
    return table.text();
}

}  // namespace

int check_portable(Session& session, std::vector<std::string> command)
{
    Run run(session, {}, std::move(command), {});
    run.experiment(portable_experiment());
    run.finish();
    std::cout << device_text(session.device()) << '\n';
    print_tables(run.results().text(), {});
    return run.results().exit_code();
}

}  // namespace bvhbench
