// SPDX-License-Identifier: MIT
#include "harness/commands/command.h"

namespace bvhbench {

extern const CommandEntry build_command, collide_command, cluster_command, run_command,
    accuracy_command, tune_command, list_command, check_command, stress_command, facts_command,
    scene_command, expand_command, view_command;

std::span<const CommandEntry> commands()
{
    // To add a command, add its line here. One without an object is implemented in plots/commands/NAME.py.
    static const CommandEntry all[] = {
        list_command,
        scene_command,
        build_command,
        collide_command,
        cluster_command,
        run_command,
        {"sweep", measuring,
         "Measure a product of scenes, sizes, builders, orders, colliders and options, a "
         "process a cell; go on where it was interrupted"},
        {"scale", measuring,
         "Run one scene on more and more devices: strong and weak scaling, and the share of the "
         "halo"},
        {"best", measuring,
         "Say which builder and collider is the fastest for scenes of yours, and by how much"},
        {"reproduce", measuring, "Measure, print and draw what the paper shows"},
        accuracy_command,
        tune_command,
        {"show", looking, "Print a result file as tables"},
        {"compare", looking,
         "Compare result files with earlier ones, cell by cell; 1 if anything got worse"},
        {"plot", looking, "Draw every figure that result files have the cells for"},
        {"report", looking,
         "Make one page of result files, and of small scenes in three dimensions"},
        {"export", looking, "Write result files in a format that other programs read"},
        {"merge", looking, "Make one result file of several, with each cell once and as it was"},
        {"data", looking,
         "List the data sets that scenes are made of, or download some into the data folder"},
        check_command,
        {"smoke", checking,
         "Run every builder and collider over small scenes and compare all with a baseline; 1 "
         "if it differs"},
        stress_command,
        facts_command,
        expand_command,
        view_command,
    };
    return all;
}

}  // namespace bvhbench
