// SPDX-License-Identifier: MIT
#include <iostream>

#include "builders/orders.h"
#include "geometry/error.h"
#include "harness/collide.h"
#include "harness/commands.h"
#include "harness/pairs_file.h"
#include "harness/report.h"
#include "harness/result_file.h"
#include "harness/run.h"

namespace bvhbench {

int collide(const CollideCommand& command, const Options& options)
{
    // Wrong words are found before anything is opened.
    find_builder(command.builder.name);
    find_order(command.builder.order);
    find_collider(command.collider.name);
    if (!command.pairs.empty())
        check_pairs_path(command.pairs);

    Session session(options.common);
    ResultFile results(command.json, measured_facts(session, options.words));
    PairList pairs;
    Cell cell = collide_scene(session, command, pairs);
    const bool differs = cell.check.verdict == Check::Verdict::differs;
    results.add(cell);
    results.finish(session.programs().compile_ns());
    const RunFacts& run = results.document().run;
    std::cout << run_report(run) << cell_report(cell, run);
    if (!command.pairs.empty())
        write_pairs(command.pairs, pairs);
    return differs ? 1 : 0;
}

}  // namespace bvhbench
