// SPDX-License-Identifier: MIT
#include "harness/commands/command.h"

namespace bvhbench {

extern const CommandEntry build_command, collide_command, run_command, accuracy_command,
    tune_command, list_command, check_command, stress_command, facts_command, settle_command,
    view_command;

namespace {

/// Returns the entry of a command that is implemented in plots/commands/NAME.py.
CommandEntry in_python(std::string_view name, std::string_view group, std::string_view summary)
{
    return {.name = name, .group = group, .summary = summary};
}

}  // namespace

std::span<const CommandEntry> commands()
{
    // To add a command, add its line here.
    static const CommandEntry all[] = {
        list_command,
        build_command,
        collide_command,
        run_command,
        in_python("sweep", measuring,
                  "Measure a product of scenes, sizes, builders, orders, colliders and options, a "
                  "process a cell; go on where it was interrupted"),
        in_python("best", measuring,
                  "Say which builder and collider is the fastest for scenes of yours, and by how "
                  "much"),
        in_python("reproduce", measuring, "Measure, print and draw what the paper shows"),
        accuracy_command,
        tune_command,
        in_python("show", looking, "Print a result file as tables"),
        in_python("compare", looking,
                  "Hold a result file to an earlier one, cell by cell; 1 if anything got worse"),
        in_python("plot", looking, "Draw every figure that result files have the cells for"),
        in_python("report", looking,
                  "Make one page of result files, and of small scenes in three dimensions"),
        in_python("merge", looking,
                  "Make one result file of several, with each cell once and as it was"),
        check_command,
        in_python("smoke", holding,
                  "Run every builder and collider over small scenes and hold all to a baseline; 1 "
                  "if it differs"),
        stress_command,
        facts_command,
        settle_command,
        view_command,
    };
    return all;
}

}  // namespace bvhbench
