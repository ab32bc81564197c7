// SPDX-License-Identifier: MIT
#include "harness/measure/cluster.h"

#include <cstdlib>
#include <iostream>
#include <utility>

#include "collide/best_pipeline.h"
#include "geometry/error.h"
#include "geometry/names.h"
#include "harness/base/failure.h"
#include "harness/base/python.h"
#include "harness/base/terminal.h"
#include "harness/choice/choices.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/record/pairs_file.h"
#include "harness/record/provenance.h"
#include "harness/record/result_file.h"
#include "process/mpirun.h"

namespace bvhbench {
namespace {

class Cluster final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_option("SCENE", task_.scene, "a scene, data set or mesh file; its first frame")
            ->required();
        app.add_option("--ranks", task_.ranks, "processes, each with a device of its own")
            ->check(CLI::Range(1u, ClusterTask::most_ranks));
        app.add_option("--partition", partition_, joined(partition_names))->capture_default_str();
        names_.add_to(app, 1);
        add_choices(app, choice_, [](const Choice& option) {
            return option.key == "adjacent" || option.key == "narrow" || option.key == "within";
        });
        app.add_option("--boxes", task_.boxes,
                       "that a rank tells the others, of a level of its tree: a power of two")
            ->check(CLI::Range(1u, ClusterTask::most_boxes))
            ->capture_default_str();
        app.add_option("--simulate", task_.simulates,
                       "count what so many ranks would send, without running them")
            ->check(CLI::Range(1u, ClusterTask::most_ranks));
        app.add_option("--frames", frames_,
                       "a:b, from frame a to before b, of a scene that moves; each is a sample");
        app.add_option("--rebalance", task_.rebalance,
                       "work of a rank, divided by the mean, above which rcb cuts the scene anew")
            ->check(CLI::Range(1.0, ClusterTask::most_rebalance))
            ->capture_default_str();
        app.add_option("--check", check_, joined(cluster_check_names))->capture_default_str();
        app.add_option("--samples", task_.samples, "timed frames")
            ->check(CLI::Range(1, ClusterTask::most_frames_timed))
            ->capture_default_str();
        app.add_flag("--share-devices", task_.share_devices,
                     "let ranks of a host share a device; for tests, gives no times");
        app.add_option("--json", json_, "write the result file");
        app.add_option("--pairs", pairs_, "write the pairs: .csv, or .bin of 32-bit ids");
        app.add_option("--contacts", contacts_,
                       "the same of those that intersect or are within the distance");
    }

    int run(const Invocation& invocation) override
    {
        check();
        if (task_.simulates != 0)
            return simulate(invocation);
        if (!ranks_started())
            return start_ranks(invocation);
        const std::unique_ptr<HostedRanks> ranks = start_mpi();
        int code = 0;
        bool of_all = false;  // and of no rank in particular
        const auto run = [&] { code = run_rank(*ranks, invocation); };
        const std::string why = reason_of_failure(run, &of_all);
        if (why.empty())
            return code;
        code = of_all ? 2 : 3;
        const std::string where =
            of_all ? "" : "rank " + std::to_string(ranks->rank()) + " on " + ranks->host() + ": ";
        std::cerr << "bvhbench: " + where + why + '\n';  // in one piece: other ranks may write too
        std::cerr.flush();
        ranks->end_all(code);
        return code;
    }

private:
    int start_ranks(const Invocation& invocation) const
    {
        if (const std::string why = mpi_absent(); !why.empty())
            throw Unavailable(why);
        const std::size_t width = terminal_width();
        std::vector<std::string> words(invocation.words.begin() + 1, invocation.words.end());
        if (width == 0)  // no terminal, but mpirun gives rank 0 one
            words.emplace_back("--wide");
        const RanksEnd end = run_ranks(task_.ranks, words, width, invocation.common.time_limit_s);
        if (!end.sentence.empty())
            std::cerr << "bvhbench: " << end.sentence << '\n';
        return end.code;
    }

    /// Throws BadUsage for wrong options, before any process is started.
    void check()
    {
        task_.partition = value_called<PartitionBy>("partition", partition_, partition_names);
        task_.check = value_called<ClusterCheck>("check", check_, cluster_check_names);
        take_best({});
        task_.wants_pairs = !pairs_.empty();
        task_.wants_contacts = !contacts_.empty();
        for (const std::string& path : {pairs_, contacts_})
            if (!path.empty())
                check_pairs_path(path, {});
        if (task_.wants_contacts && !task_.has_narrow())
            throw BadUsage("--contacts takes a narrow phase: --narrow exact, or --within");
        if (task_.wants_pairs && task_.is_within())
            throw BadUsage(
                "--within finds pairs of triangles and none of boxes: --contacts, not --pairs");
        const std::optional<unsigned> started = ranks_started();
        if (!frames_.empty())
            task_.frames = frame_range(frames_);
        if (task_.moves() && (task_.wants_pairs || task_.wants_contacts))
            throw BadUsage(
                "--pairs and --contacts write those of the first frame, without --frames");
        check_task(task_);
        if (task_.simulates != 0 &&
            (task_.ranks != 0 || started || task_.wants_pairs || task_.wants_contacts))
            throw BadUsage(
                "--simulate runs no ranks and finds no pairs: without --ranks, --pairs and "
                "--contacts");
        if (!started && task_.ranks == 0 && task_.simulates == 0)
            throw BadUsage("--ranks says how many processes to start, unless mpirun starts them");
        if (started && task_.ranks != 0 && task_.ranks != *started)
            throw BadUsage("--ranks asks for " + std::to_string(task_.ranks) +
                           " ranks, and there are " + std::to_string(*started));
    }

    void take_best(const BestPipeline& best)
    {
        SeveralNames names = names_;
        chosen_ = names.take_best(best, choice_.builder);
        const CellChoice choice = names.combined_with(choice_).front();
        task_.pipeline = {choice.builder, choice.collider};
    }

    int simulate(const Invocation& invocation)
    {
        Session session(invocation.common);
        take_best(best_pipeline(session.device()));
        const OutputRules rules =
            result_rules(invocation.common.force, scene_files(task_.scene, session.scenes()));
        ResultFile results(Output(json_, "--json", rules), invocation.common.force);
        Json facts = run_facts(session.device(), invocation.words);
        const Cell cell = cell_of(simulate_cluster(session, task_));
        return finish(results, std::move(facts), cell, session, invocation);
    }

    /// Writes the result file, which is not begun before, so that a killed rank leaves nothing, and prints it. Returns the exit code.
    int finish(ResultFile& results, Json facts, const Cell& cell, const Session& session,
               const Invocation& invocation) const
    {
        results.begin(with_cluster_facts(std::move(facts)));
        results.begin_part({});
        results.add(cell);
        results.finish(session.end_of_run());
        std::cout << (invocation.common.quiet ? "" : chosen_) << std::flush;
        print_tables(results.text(), invocation.common);
        return results.exit_code();
    }

    int run_rank(HostedRanks& ranks, const Invocation& invocation)
    {
        CommonOptions common = invocation.common;
        common.device = device_of_rank(common.device, ranks, task_.share_devices);
        Session session(common);
        take_best(best_pipeline(session.device()));
        const bool is_first = ranks.rank() == 0;
        const OutputRules rules =
            result_rules(common.force, scene_files(task_.scene, session.scenes()));
        ResultFile results(is_first ? Output(json_, "--json", rules) : Output(), common.force);
        const Output pairs = is_first ? Output(pairs_, "--pairs", rules) : Output();
        const Output contacts = is_first ? Output(contacts_, "--contacts", rules) : Output();
        PairsFile pairs_file(pairs, false),
            contacts_file(
                contacts, false,
                task_.is_within() ? PairsFile::With::distances : PairsFile::With::nothing);
        session.check_clocks();
        Json facts = run_facts(session.device(), invocation.words);
        const ClusterFound found = run_cluster(ranks, session, task_);
        if (!is_first)
            return 0;
        pairs_file.add(found.pairs, 0, found.scene);
        pairs_file.finish();
        contacts_file.add(found.contacts, 0, found.scene);
        contacts_file.finish();
        setenv("NO_COLOR", "1", 1);  // the terminal of rank 0 may end in a file
        return finish(results, std::move(facts), cell_of(found.result), session, invocation);
    }

    ClusterTask task_;
    SeveralNames names_;
    CellChoice choice_{task_.pipeline.builder, task_.pipeline.collider};
    std::string chosen_;
    std::string partition_ = "rcb", check_ = "auto";
    std::string json_, pairs_, contacts_, frames_;
};

}  // namespace

extern const CommandEntry cluster_command = {
    "cluster",
    measuring,
    "Find the pairs of one scene on several devices, by MPI, and compare them with those of one",
    "Each rank has a part of the scene and builds a tree over it. Triangles that meet another "
    "rank's boxes are sent there, so that every pair is found once. Under mpirun or Slurm the "
    "ranks are theirs; otherwise mpirun is started on this host.",
    {{"bvhbench cluster torus:2880000 --ranks 4", "four devices of this host"},
     {"bvhbench cluster bunny --ranks 2 --share-devices --partition curve --pairs pairs.csv",
      "a test on one device"}},
    "docs/cluster.md",
    make_command<Cluster>};

}  // namespace bvhbench
