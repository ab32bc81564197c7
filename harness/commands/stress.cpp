// SPDX-License-Identifier: MIT
#include "geometry/error.h"
#include "harness/base/python.h"
#include "harness/choice/outside.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/record/provenance.h"
#include "harness/record/result_file.h"
#include "harness/stress/run.h"

namespace bvhbench {
namespace {

class Stress final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_flag("--quick", task_.size.quick, "smaller scenes and fewer systems");
        app.add_option("--seed", task_.size.seed, "of what is random")->capture_default_str();
        app.add_option("--filter", filter_, "only cells whose family/scene/system this matches");
        app.add_option("--out", out_, "write the result file");
    }

    int run(const Invocation& invocation) override
    {
        task_.filter = cell_filter(filter_);
        const CommonOptions& common = invocation.common;
        refuse_outside(common, "stress");
        Session session(common);
        ResultFile results(Output(out_, "--out", result_rules(common.force, {})), common.force,
                           run_facts(session.device(), invocation.words));
        bool has_fault = false, all_refused = true;
        std::string why_refused;
        stress_all(session, task_, [&](StressCell&& cell) {
            has_fault = has_fault || is_our_fault(cell);
            all_refused = all_refused && is_refused(cell);
            if (why_refused.empty() && is_refused(cell))
                why_refused = cell.findings.begin()->second.detail;
            results.add(cell);
        });
        if (results.size() == 0)
            throw BadUsage("--filter: no cell of stress matches '" + filter_ + "'");
        results.finish(session.end_of_run());
        print_tables(results.text(), common);
        if (!has_fault && all_refused)
            throw NothingMeasured("nothing was measured: " + why_refused);
        return has_fault ? 1 : 0;
    }

private:
    StressTask task_;
    std::string filter_, out_;
};

}  // namespace

extern const CommandEntry stress_command = {
    "stress",
    checking,
    "Check builders, colliders and libraries over scenes that are hard on them",
    "1 if one of ours is wrong, whatever libraries do.",
    {{"bvhbench stress --quick", "minutes"},
     {"bvhbench stress --seed 7 --out stress.json", "all, and a file for `bvhbench plot`"},
     {"bvhbench stress --filter ^scale/.*/front", "cells whose family/scene/system this matches"}},
    "docs/stress.md",
    make_command<Stress>};

}  // namespace bvhbench
