// SPDX-License-Identifier: MIT
#include "harness/measure/run.h"

#include <iostream>

#include "geometry/error.h"
#include "harness/base/python.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/session/watchdog.h"

namespace bvhbench {
namespace {

class RunExperiment final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_option("EXPERIMENT", name_, "a name of `list experiments`, or a .json file")
            ->required();
        app.add_option("--out", out_,
                       "the result file; default: <experiment>.json, of a file's experiment "
                       "<experiment>-results.json");
        app.add_option("--filter", filter_, "only cells whose scene/builder this matches");
        add_sampling(app, samples_, "timed builds a cell", sampling_);
        app.add_option("--turns", turns_,
                       "FILE:N: sample by turns with other runs, N in all, that name the file");
        app.add_flag("--quick", quick_, "fewer scenes and samples");
        add_quality(app, quality_, costs_);
    }

    int run(const Invocation& invocation) override
    {
        const Experiment experiment = this->experiment();
        const CellFilter filter = cell_filter(filter_);
        if (parts_of(experiment, filter) == 0)
            throw BadUsage("--filter: no cell of " + experiment.name + " matches '" + filter_ +
                           "'");
        const bool is_file = name_.ends_with(".json");
        const std::string out = !out_.empty() ? out_
                                : is_file     ? experiment.name + "-results.json"
                                              : experiment.name + ".json";
        const CommonOptions& common = invocation.common;
        Session session(common);
        std::vector<std::string> scenes = experiment.scenes;
        for (const CollideTask& task : experiment.collisions)
            scenes.push_back(task.scene);
        std::vector<std::string> inputs = files_of(scenes, session.scenes());
        if (is_file)
            inputs.push_back(name_);
        Run run(
            session,
            Output(out, "--out", result_rules(common.force, std::move(inputs), watchdog::run_id())),
            invocation.words, costs_);
        session.take_turns(turns_, run.results().run_id());
        run.experiment(experiment, filter);
        run.finish();
        print_tables(run.results().text(), common);
        std::cout << run.results().written();
        return run.results().exit_code();
    }

private:
    Experiment experiment() const
    {
        Experiment experiment = find_experiment(name_, quick_);
        if (samples_ > 0) {
            experiment.samples = samples_;
            experiment.sampling.until = 0;
            for (CollideTask& task : experiment.collisions)
                task.samples = samples_;
        }
        sampling_.apply(experiment.sampling);
        for (CollideTask& task : experiment.collisions)
            task.sampling = experiment.sampling;
        experiment.quality = experiment.quality || quality_;
        return experiment;
    }

    std::string name_, out_, filter_, turns_;
    int samples_ = 0;  ///< 0: the experiment's number
    SamplingWords sampling_;
    bool quick_ = false;
    bool quality_ = false;
    NodeCosts costs_;
};

}  // namespace

extern const CommandEntry run_command = {
    "run",
    measuring,
    "Run an experiment and write its result file",
    "An experiment is a list of scenes, builders, colliders and samples, as JSON; some are in the "
    "program. Builders of a scene are sampled in turn. What is finished is in the result file at "
    "once.",
    {{"bvhbench run peers --out peers.json", "an experiment of `list experiments`"},
     {"bvhbench run mine.json --filter bunny/oibvh --samples 50",
      "one of your own, and part of it"},
     {"bvhbench run smoke --turns turns:2 --out a.json",
      "by turns with a second run of another build"}},
    "docs/experiments.md",
    make_command<RunExperiment>};

}  // namespace bvhbench
