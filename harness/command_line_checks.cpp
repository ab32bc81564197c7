// SPDX-License-Identifier: MIT
#include "harness/command_line.h"

namespace bvhbench {

void add_check(CLI::App& app, CheckCommand& check)
{
    CLI::App* command =
        app.add_subcommand("check", "Hold builders to every promise, without timing");
    command->add_option("--builder", check.builder, "only this one");
    command->add_option("--scene", check.scene, "over this instead of the hard inputs");
    command
        ->add_flag("--portable", check.portable,
                   "instead: the device, and a verdict on each builder, collider and narrow phase, "
                   "to be sent")
        ->excludes("--builder")
        ->excludes("--scene");
}

void add_smoke(CLI::App& app, SmokeCommand& smoke)
{
    CLI::App* command = app.add_subcommand("smoke",
                                           "Run every builder and collider over small scenes and "
                                           "hold all to a baseline; 1 if it differs");
    command->add_option("--baseline", smoke.baseline,
                        "the baseline; default: results/baseline/smoke-<device kind>.json");
    command->add_flag("--update", smoke.update, "write the baseline instead of holding to it");
    command->add_option("--filter", smoke.filter, "only cells whose scene/builder this matches");
    command->add_option("--out", smoke.out, "write the result file");
    command
        ->add_option("--tolerance", smoke.tolerance,
                     "by how much a time beside the others of its scene may be longer, as a ratio")
        ->capture_default_str()
        ->check(CLI::Range(1.0, 1e12));
}

void add_stress(CLI::App& app, StressCommand& stress)
{
    CLI::App* command = app.add_subcommand("stress",
                                           "Hold builders, colliders and libraries to what must "
                                           "hold over scenes that are hard on them");
    command->add_flag("--quick", stress.quick, "smaller scenes and fewer systems");
    command->add_option("--seed", stress.seed, "of what is random")->capture_default_str();
    command->add_option("--filter", stress.filter,
                        "only cells whose family/scene/system this matches");
    command->add_option("--out", stress.out, "write the result file");
}

void add_accuracy(CLI::App& app, AccuracyCommand& accuracy)
{
    CLI::App* command = app.add_subcommand(
        "accuracy", "Measure run time against error, along an axis at a time, print and draw it");
    command->add_option("--axis", accuracy.axis, "a name of `list accuracy`; default: all in turn");
    command->add_option("--scene", accuracy.scenes,
                        "scenes, data sets or mesh files, of axes that are about scenes");
    command
        ->add_option("--pairs", accuracy.pairs,
                     "pairs of triangles in all, of the axis narrow, at least one a class")
        ->capture_default_str()
        ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 32));
    command->add_option("--seed", accuracy.seed, "of what is generated")
        ->capture_default_str()
        ->check(CLI::Range(1u, 1000000000u));
    command->add_option("--filter", accuracy.filter, "only cells whose input/method this matches");
    command->add_option("--samples", accuracy.samples, "timed runs a cell")
        ->capture_default_str()
        ->check(CLI::Range(1, most_samples));
    command->add_option("--out", accuracy.out, "folder for the result file and figures")
        ->capture_default_str();
}

}  // namespace bvhbench
