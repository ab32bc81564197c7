// SPDX-License-Identifier: MIT
#include <iostream>

#include "collide/narrow/narrow_methods.h"
#include "harness/base/python.h"
#include "harness/base/table.h"
#include "harness/base/terminal.h"
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
        for (const NarrowMethod& method : narrow_methods(NarrowOf::moment)) {
            pipeline.collider.narrow = method.name;
            if (pipeline != task.pipelines.front())
                task.pipelines.push_back(pipeline);
        }
    }
    return experiment;
}

std::string device_text(const Device& device)
{
    Table table({"<", "<"});
    const Json run = run_facts(device, {});
    for (const auto& [key, value] : run["device"].items())
        table.row({key == "name" ? "device" : key,
                   value.is_string() ? value.get<std::string>() : value.dump()});
    table.row({"loops", device.ends_loops ? "end after 65,535 steps" : "end by themselves"});
    table.row({"extensions", device.cl.getInfo<CL_DEVICE_EXTENSIONS>()});
    return table.text(terminal_width());
}

}  // namespace

int check_portable(Session& session, std::vector<std::string> command)
{
    ResultFile results({}, false, measured_facts(session, std::move(command)));
    Run(session, results, {}).experiment(portable_experiment());
    results.finish(session.end_of_run());
    std::cout << device_text(session.device()) << '\n';
    print_tables(results.text(), {});
    return results.exit_code();
}

}  // namespace bvhbench
