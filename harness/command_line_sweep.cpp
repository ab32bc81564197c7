// SPDX-License-Identifier: MIT
#include "harness/command_line.h"

namespace bvhbench {
namespace {

constexpr int most_seconds = 10000000;
constexpr unsigned most_jobs = 1024;

/// What is measured.
void add_product(CLI::App& command, SweepCommand& sweep)
{
    const auto list = [&](const char* option, std::vector<std::string>& values, const char* what) {
        command.add_option(option, values, what)->delimiter(',')->allow_extra_args(false);
    };
    command.add_option("FILE", sweep.file,
                       "the sweep as JSON (docs/sweeps.md); options take the place of its keys");
    command.add_option("--name", sweep.name,
                       "the sweep's name: cells' experiment, and the result file's");
    list("--scenes", sweep.scenes,
         "scenes, data sets or mesh files; {size}, or a generator's bare name, takes each size");
    command.add_option("--sizes", sweep.sizes,
                       "triangles: 1000,30000 or 1000:1000000:x10 or 1000:5000:+1000");
    list("--builders", sweep.builders, "names of `list builders`");
    list("--orders", sweep.orders, "names of `list orders`");
    list("--colliders", sweep.colliders,
         "names of `list colliders`; without, cells are builds; with, whole frames");
    command
        .add_option(
            "--set", sweep.set,
            "KEY=V1,V2: goes through values of an option: boxes, leaves, items, "
            "builder.group_size, narrow, adjacent, jump, frames and others; may be said again")
        ->allow_extra_args(false);
    command.add_option("--samples", sweep.samples, "timed runs a cell; default: 20")
        ->check(CLI::Range(1, most_samples));
    command
        .add_option("--warm-up", sweep.warm_up, "runs before them that do not count; default: 3")
        ->check(CLI::Range(0, most_samples));
    add_quality(command, sweep.quality, sweep.costs);
}

}  // namespace

void add_sweep(CLI::App& app, SweepCommand& sweep)
{
    CLI::App* command = app.add_subcommand(
        "sweep",
        "Measure a product of scenes, sizes, builders, orders, colliders and options, a process "
        "a cell; go on where it was interrupted");
    add_product(*command, sweep);
    command
        ->add_option("--out", sweep.out,
                     "the folder of the sweep: the same command goes on with what is there")
        ->required();
    command
        ->add_option("--device", sweep.devices,
                     "as for all commands; more than once: processes are dealt to these, which "
                     "must be alike")
        ->allow_extra_args(false);
    command
        ->add_option("--jobs", sweep.jobs,
                     "processes at a time; default: one for each --device, else 1")
        ->check(CLI::Range(1u, most_jobs));
    command->add_option("--shard", sweep.shard,
                        "i/n: only the i-th of n parts, for n machines; then merge their files");
    command
        ->add_option("--together", sweep.together,
                     "cell or scene: what a process measures; of a scene all at once, so that "
                     "samples of builders are interleaved")
        ->capture_default_str()
        ->check(one_of({"cell", "scene"}));
    command
        ->add_option("--cell-limit", sweep.cell_limit_s,
                     "seconds that a process may take in all before it is ended; 0: no end")
        ->capture_default_str()
        ->check(a_number(most_seconds));
    command->add_flag("--continue-other-commit", sweep.continue_other_commit,
                      "keep cells that another commit has measured, and go on with this one");
    command->add_flag("--retry-failed", sweep.retry_failed, "measure cells that failed again");
    command->add_flag("--dry-run", sweep.dry_run, "print the cells and measure none");
}

}  // namespace bvhbench
