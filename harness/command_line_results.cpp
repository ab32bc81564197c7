// SPDX-License-Identifier: MIT
#include "harness/command_line.h"

namespace bvhbench {

void add_show(CLI::App& app, ShowCommand& show)
{
    CLI::App* command = app.add_subcommand("show", "Print a result file as tables");
    command->add_option("FILE", show.file, "a result file")->required();
}

void add_compare(CLI::App& app, CompareCommand& compare)
{
    CLI::App* command = app.add_subcommand(
        "compare", "Hold a result file to an earlier one, cell by cell; 1 if anything got worse");
    command->add_option("A", compare.first, "the earlier result file")->required();
    command->add_option("B", compare.second, "the later one")->required();
    command
        ->add_option("--threshold", compare.threshold,
                     "the smallest change of time that counts, as 5% or 0.05")
        ->transform(a_share(10))
        ->default_str("5%");
    command->add_flag("--all", compare.all, "show cells that are unchanged, too");
    command->add_flag("--allow-missing", compare.allow_missing,
                      "cells and counters that only A has are no regression");
    command->add_flag("--allow-dirty", compare.allow_dirty,
                      "files of programs with changes that no commit has");
    command->add_flag("--other-devices", compare.other_devices,
                      "files of two devices: compare verdicts, and times as ratios within a scene");
    command
        ->add_flag("--test-hooks", compare.allow_test_hooks,
                   "files made under a test hook, which are no results")
        ->group("");  // for the tests of this command
}

void add_merge(CLI::App& app, MergeCommand& merge)
{
    CLI::App* command = app.add_subcommand(
        "merge", "Make one result file of several, with each cell once and as it was");
    command->add_option("FILE", merge.files, "result files of one format")->required();
    command->add_option("-o,--out", merge.out, "the file to write")->required();
    command->add_flag("--other-devices", merge.other_devices,
                      "even if they were measured on different devices");
    command->add_flag("--other-commits", merge.other_commits,
                      "even if different commits of this program measured them");
}

void add_plot(CLI::App& app, PlotCommand& plot)
{
    CLI::App* command =
        app.add_subcommand("plot", "Draw every figure that result files have the cells for");
    command->add_option("FILE", plot.files, "result files, or folders of them")->required();
    command->add_option("--out", plot.out, "the folder for pictures")->capture_default_str();
}

void add_report(CLI::App& app, ReportCommand& report, std::string& leaves)
{
    CLI::App* command = app.add_subcommand(
        "report", "Make one page of result files, and of small scenes in three dimensions");
    command->add_option("FILE", report.files, "result files");
    command->add_option("-o,--out", report.out, "the page")->capture_default_str();
    command->add_option("--scene", report.scenes,
                        "small scenes to show: their triangles, the boxes of each level of a tree, "
                        "and what collides");
    command->add_option("--frame", report.frame, "of those scenes, from 0")->capture_default_str();
    command->add_option("--builder", report.builder.name, "whose tree: a name of `list builders`")
        ->capture_default_str();
    command->add_option("--order", report.builder.order, "a name of `list orders`")
        ->capture_default_str();
    add_leaves(*command, leaves, report.builder.boxes);
    command
        ->add_option("--collider", report.collider.name,
                     "what finds the pairs: a name of `list colliders`")
        ->capture_default_str();
}

}  // namespace bvhbench
