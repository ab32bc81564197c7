// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iostream>

#include "geometry/error.h"
#include "harness/commands.h"
#include "harness/provenance.h"
#include "harness/report.h"
#include "harness/result_file.h"
#include "harness/run.h"
#include "harness/stress/report.h"
#include "harness/stress/run.h"

namespace bvhbench {

int stress(const StressCommand& command, const Options& options)
{
    StressTask task;
    task.size = {command.quick, command.seed};
    task.filter = cell_filter(command.filter);
    Session session(options.common);
    Output output(command.out, "--out", result_rules(options.common.force, {}));
    ResultFile results(std::move(output), run_facts(session.device(), options.words));
    stress_all(session, task, [&](StressCell&& cell) { results.add(std::move(cell)); });
    const Document& document = results.document();
    if (document.stress.empty())
        throw BadUsage("--filter: no cell of stress matches '" + command.filter + "'");
    results.finish(session.programs().compile_ns());
    std::cout << run_report(document.run) << stress_report(document.stress, document.run.libraries);
    return std::any_of(document.stress.begin(), document.stress.end(), is_our_fault) ? 1 : 0;
}

}  // namespace bvhbench
