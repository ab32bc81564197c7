// SPDX-License-Identifier: MIT
#include "harness/measure/run.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <set>

#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/base/build_info.h"
#include "harness/base/python.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/measure/cluster.h"
#include "harness/record/provenance.h"
#include "process/watchdog.h"

namespace bvhbench {
namespace {

class RunExperiment final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_option("EXPERIMENT", name_,
                       "a name of `list experiments`, or a .json file of an experiment or a plan")
            ->required();
        app.add_option("--out", out_,
                       "the result file; default: <experiment>.json, of a file's experiment "
                       "<experiment>-results.json");
        app.add_option("--filter", filter_, "only cells whose scene/builder this matches");
        add_sampling(app, samples_, "timed builds a cell", sampling_);
        app.add_option("--turns", turns_,
                       "FILE:N: sample by turns with other runs, N in all, that name the file");
        app.add_option("--only", only_,
                       "i/n: only the i-th of n shares of the scenes; then merge the files");
        app.add_flag("--resume", resuming_.is_asked,
                     "go on with what the result file and its journal have");
        app.add_flag("--continue-other-commit", resuming_.other_commits,
                     "with --resume: keep cells that another commit has measured");
        app.add_flag("--retry-failed", resuming_.retries_failed,
                     "with --resume: measure scenes with a failed cell again");
        app.add_flag("--quick", quick_, "fewer scenes and samples");
        add_quality(app, quality_, costs_);
    }

    int run(const Invocation& invocation) override
    {
        const RunPlan plan = this->plan();
        const CellFilter filter = cell_filter(filter_);
        const PlanShare share = share_called(only_);
        const auto scenes_with = [&](const std::string& settings) {
            return planned_scenes(plan, filter, share, settings);
        };
        if (planned_scenes(plan, filter, {}, "").empty() && plan.impossible.empty())
            throw BadUsage("--filter: no cell of " + plan.name + " matches '" + filter_ + "'");
        if (scenes_with("").empty() && share.i > 1)
            throw BadUsage("--only: " + plan.name + " has fewer than " + std::to_string(share.i) +
                           " scenes");
        const CommonOptions& common = invocation.common;
        ResultFile results(
            Output(out(plan), "--out",
                   result_rules(common.force, inputs(plan, common), resuming_.is_asked)),
            common.force, resuming_, watchdog::run_id());
        watchdog::let_signals_through();
        Session session(common);
        const std::string settings = this->settings(session, common);
        const std::vector<PlannedScene> scenes = scenes_with(settings);
        const std::set<std::string> keys = keys_of(planned_scenes(plan, filter, {}, settings));
        if (resuming_.is_asked)
            results.check_earlier(keys, run_facts(session.device(), {}));
        tell_absent(scenes, filter, plan.name);
        Run run(session, results, costs_, common);
        const auto begin = [&] {
            results.begin(results.has_begun() ? Json() : facts(session, invocation, plan));
            watchdog::resume_after_crash(results.run_id());
            session.take_turns(turns_, results.run_id());
        };
        if (!run.scenes(plan, scenes, filter, begin))
            return 0;
        if (scenes.empty())
            begin();
        if (share.i == 1)
            for (const Json& cell : plan.impossible)
                results.add_impossible(cell);
        results.finish(session.end_of_run());
        print_tables(results.text(), common);
        std::cout << results.written();
        return results.exit_code();
    }

private:
    RunPlan plan() const
    {
        if (!resuming_.is_asked && (resuming_.other_commits || resuming_.retries_failed))
            throw BadUsage("--continue-other-commit and --retry-failed need --resume");
        RunPlan plan = find_plan(name_, quick_);
        if (plan.has_parts && !turns_.empty())
            throw BadUsage("--turns is for an experiment: the parts of a plan have a process each");
        for (Experiment& experiment : plan.parts)
            apply_options(experiment);
        return plan;
    }

    void apply_options(Experiment& experiment) const
    {
        if (samples_ > 0) {
            experiment.samples = samples_;
            experiment.sampling.until = 0;
            for (CollideTask& task : experiment.collisions)
                task.samples = samples_;
            for (ClusterTask& task : experiment.clusters)
                task.samples = samples_;
        }
        sampling_.apply(experiment.sampling);
        for (CollideTask& task : experiment.collisions)
            task.sampling = experiment.sampling;
        experiment.quality = experiment.quality || quality_;
    }

    Json facts(Session& session, const Invocation& invocation, const RunPlan& plan) const
    {
        Json facts = measured_facts(session, invocation.words, costs_);
        const auto has_ranks = [](const Experiment& part) { return !part.clusters.empty(); };
        return std::ranges::any_of(plan.parts, has_ranks) ? with_cluster_facts(std::move(facts))
                                                          : facts;
    }

    std::string out(const RunPlan& plan) const
    {
        const bool is_file = name_.ends_with(".json");
        return !out_.empty() ? out_ : plan.name + (is_file ? "-results.json" : ".json");
    }

    std::vector<std::string> inputs(const RunPlan& plan, const CommonOptions& common) const
    {
        std::vector<std::string> scenes;
        for (const PlannedScene& planned : planned_scenes(plan, {}, {}, ""))
            scenes.push_back(planned.name);
        std::vector<std::string> inputs = files_of(scenes, scene_library(common));
        if (name_.ends_with(".json"))
            inputs.push_back(name_);
        return inputs;
    }

    /// Returns what decides, beside the plan, what is measured. Of a program with changes in no commit, its file is part of it.
    std::string settings(const Session& session, const CommonOptions& common) const
    {
        Json words = {filter_,        samples_,
                      sampling_.race, sampling_.caches,
                      quick_,         quality_,
                      costs_.inner,   costs_.triangle,
                      common.doubles, session.device().tuning.values()};
        for (const auto& one :
             {sampling_.until, sampling_.time_budget_s, sampling_.energy_s, sampling_.drift_limit})
            words.push_back(one.value_or(0));
        for (const auto& one :
             {sampling_.min_samples, sampling_.max_samples, sampling_.calibrate_every})
            words.push_back(one.value_or(0));
        if (build_info.dirty)
            words.push_back(hash_of_program());
        return words.dump();
    }

    static std::string hash_of_program()
    {
        std::ifstream file("/proc/self/exe", std::ios::binary);
        const std::string program(std::istreambuf_iterator<char>(file), {});
        Hash hash;
        hash.bytes(program.data(), program.size());
        return hex(hash.get());
    }

    /// Says which methods from outside are in no cell of these scenes.
    static void tell_absent(const std::vector<PlannedScene>& scenes, const CellFilter& filter,
                            const std::string& plan)
    {
        std::set<std::string> there;
        for (const PlannedScene& scene : scenes)
            for (const Cell& cell : planned_cells(scene, filter))
                there.insert({cell.builder.name, cell.collider.name});
        for (const outside::Offer& offer : outside_offers())
            if (const std::string& name = offer.method.name;
                !there.contains(name) && !there.contains(name + "-refit"))
                std::cerr << name << ", from outside, takes no part in " << plan << '\n';
    }

    /// Throws BadUsage if a key is there twice.
    static std::set<std::string> keys_of(const std::vector<PlannedScene>& scenes)
    {
        std::set<std::string> keys;
        for (const PlannedScene& scene : scenes)
            if (!keys.insert(scene.key).second)
                throw BadUsage("two parts of the plan are the same, over " + scene.name);
        return keys;
    }

    std::string name_, out_, filter_, turns_, only_;
    Resuming resuming_;
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
    "Run an experiment, or a plan of several, and write its result file",
    "An experiment is a list of scenes, builders, colliders and samples, as JSON; some are in the "
    "program. Builders of a scene are sampled in turn. While it runs, finished cells are in a "
    "journal beside the result file, from which --resume goes on.",
    {{"bvhbench run peers --out peers.json", "an experiment of `list experiments`"},
     {"bvhbench run mine.json --filter bunny/oibvh --samples 50",
      "one of your own, and part of it"},
     {"bvhbench run plan.json --only 2/8 --resume --out part-2.json",
      "the second of eight machines"},
     {"bvhbench run smoke --turns turns:2 --out a.json",
      "by turns with a second run of another build"}},
    "docs/experiments.md",
    make_command<RunExperiment>};

}  // namespace bvhbench
