// SPDX-License-Identifier: MIT
#include "harness/measure/cluster.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <iostream>

#include "collide/narrow/narrow_methods.h"
#include "geometry/error.h"
#include "geometry/names.h"
#include "harness/base/failure.h"
#include "harness/base/terminal.h"
#include "harness/choice/choices.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/record/output.h"
#include "harness/record/pairs_file.h"
#include "harness/record/provenance.h"
#include "process/mpirun.h"

namespace bvhbench {
namespace {

constexpr unsigned most_ranks = 4096, most_boxes = 4096;
constexpr int most_samples_of_frames = 10000;

class Cluster final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        task_.pipeline = {{.name = "oibvh-multi"}, {.name = "leaf"}};
        app.add_option("SCENE", task_.scene, "a scene, data set or mesh file; its first frame")
            ->required();
        app.add_option("--ranks", ranks_, "processes, each with a device of its own")
            ->check(CLI::Range(1u, most_ranks));
        app.add_option("--partition", partition_, joined(partition_names))->capture_default_str();
        app.add_option("--builder", task_.pipeline.builder.name, "a name of `list builders`")
            ->capture_default_str();
        app.add_option("--order", task_.pipeline.builder.order, "a name of `list orders`")
            ->capture_default_str();
        app.add_option("--collider", task_.pipeline.collider.name, "a name of `list colliders`")
            ->capture_default_str();
        add_choices(app, choice_, [](const Choice& option) {
            return option.key == "adjacent" || option.key == "narrow";
        });
        app.add_option("--boxes", task_.boxes,
                       "that a rank tells the others, of a level of its tree: a power of two")
            ->check(CLI::Range(1u, most_boxes))
            ->capture_default_str();
        app.add_option("--simulate", simulated_,
                       "count what so many ranks would send, without running them")
            ->check(CLI::Range(1u, most_ranks));
        app.add_option("--frames", frames_,
                       "a:b, from frame a to before b, of a scene that moves; each is a sample");
        app.add_option("--rebalance", task_.rebalance,
                       "work of a rank, divided by the mean, above which rcb cuts the scene anew")
            ->check(CLI::Range(1.0, 1e6))
            ->capture_default_str();
        app.add_option("--check", check_, joined(cluster_check_names))->capture_default_str();
        app.add_option("--samples", task_.samples, "timed frames")
            ->check(CLI::Range(1, most_samples_of_frames))
            ->capture_default_str();
        app.add_flag("--share-devices", task_.share_devices,
                     "let ranks of a host share a device; for tests, gives no times");
        app.add_option("--json", json_, "write the result file");
        app.add_option("--pairs", pairs_, "write the pairs: .csv, or .bin of 32-bit ids");
        app.add_option("--contacts", contacts_, "the same of the pairs that intersect");
    }

    int run(const Invocation& invocation) override
    {
        check();
        if (simulated_ != 0)
            return simulate(invocation);
        if (!ranks_started())
            return start_ranks(invocation);
        const std::unique_ptr<HostedRanks> ranks = start_mpi();
        int code = 0;
        std::string sentence;
        try {
            return run_rank(*ranks, invocation);
        } catch (const BadUsage& error) {  // of no rank in particular
            code = 2;
            sentence = sentence_of(error);
        } catch (const std::exception& error) {
            code = 3;
            sentence = "rank " + std::to_string(ranks->rank()) + " on " + ranks->host() + ": " +
                       sentence_of(error);
        }
        std::cerr << "bvhbench: " + sentence + '\n';  // in one piece: other ranks may write too
        std::cerr.flush();
        ranks->end_all(code);
        return code;
    }

private:
    int start_ranks(const Invocation& invocation) const
    {
        if (const std::string why = mpi_absent(); !why.empty())
            throw Unavailable(why);
        constexpr std::size_t no_terminal = 10000;  // columns: tables are not wrapped
        const std::size_t width = terminal_width(STDOUT_FILENO);
        return run_ranks(ranks_, {invocation.words.begin() + 1, invocation.words.end()},
                         width == 0 ? no_terminal : width, invocation.common.time_limit_s);
    }

    /// Returns the value of `Kind` with this name among `names`; throws BadUsage if there is none.
    template <class Kind, std::size_t count>
    static Kind named(const std::string& what, const std::string& name,
                      const std::string_view (&names)[count])
    {
        const auto found = std::ranges::find(names, name);
        if (found == std::end(names))
            throw BadUsage("no " + what + " is called '" + name + '\'' + there_are(name, names));
        return static_cast<Kind>(found - std::begin(names));
    }

    /// Throws BadUsage for wrong options, before any process is started.
    void check()
    {
        task_.partition = named<PartitionBy>("partition", partition_, partition_names);
        task_.check = named<ClusterCheck>("check", check_, cluster_check_names);
        task_.pipeline.collider.keep_adjacent = choice_.collider.keep_adjacent;
        task_.pipeline.collider.narrow = choice_.collider.narrow;
        check_choice({task_.pipeline.builder, task_.pipeline.collider});
        check_narrow_of(task_.pipeline.collider.narrow, false);
        find_order(task_.pipeline.builder.order);
        task_.wants_pairs = !pairs_.empty();
        if (task_.wants_pairs)
            check_pairs_path(pairs_, {});
        task_.wants_contacts = !contacts_.empty();
        if (task_.wants_contacts)
            check_pairs_path(contacts_, {});
        if (task_.wants_contacts && task_.pipeline.collider.narrow == "none")
            throw BadUsage("--contacts takes a narrow phase: --narrow exact");
        triangles_in_name(task_.scene);  // throws for a name that no scene can have
        const std::optional<unsigned> started = ranks_started();
        if (!frames_.empty())
            task_.frames = frame_range(frames_);
        if (task_.frames != FrameRange{} && (task_.wants_pairs || task_.wants_contacts))
            throw BadUsage(
                "--pairs and --contacts write those of the first frame, without --frames");
        if (!std::has_single_bit(task_.boxes))
            throw BadUsage("--boxes is a power of two, not " + std::to_string(task_.boxes));
        if (simulated_ != 0 &&
            (ranks_ != 0 || started || task_.wants_pairs || task_.wants_contacts))
            throw BadUsage(
                "--simulate runs no ranks and finds no pairs: without --ranks, --pairs and "
                "--contacts");
        if (!started && ranks_ == 0 && simulated_ == 0)
            throw BadUsage("--ranks says how many processes to start, unless mpirun starts them");
        if (started && ranks_ != 0 && ranks_ != *started)
            throw BadUsage("--ranks asks for " + std::to_string(ranks_) + " ranks, and there are " +
                           std::to_string(*started));
    }

    int simulate(const Invocation& invocation)
    {
        Session session(invocation.common);
        const Output json(json_, "--json",
                          {invocation.common.force, scene_files(task_.scene, session.scenes())});
        const Simulation simulation = simulate_cluster(session, task_, simulated_);
        if (!json.is_nowhere())
            json.replace(
                simulation_json(simulation, run_facts(session.device(), invocation.words)).dump(1) +
                "\n");
        if (!invocation.common.quiet)
            std::cout << simulation_text(simulation);
        return 0;
    }

    int run_rank(HostedRanks& ranks, const Invocation& invocation)
    {
        CommonOptions common = invocation.common;
        common.device = device_of_rank(common.device, ranks, task_.share_devices);
        Session session(common);
        const bool is_first = ranks.rank() == 0;
        const OutputRules rules{common.force, scene_files(task_.scene, session.scenes())};
        const Output json = is_first ? Output(json_, "--json", rules) : Output();
        const Output pairs = is_first ? Output(pairs_, "--pairs", rules) : Output();
        const Output contacts = is_first ? Output(contacts_, "--contacts", rules) : Output();
        PairsFile pairs_file(pairs, false), contacts_file(contacts, false);
        session.check_clocks();
        const ClusterFound found = run_cluster(ranks, session, task_);
        if (!is_first)
            return 0;
        const ClusterResult& result = found.result;
        pairs_file.add(found.pairs, 0, found.scene);
        pairs_file.finish();
        contacts_file.add(found.contacts, 0, found.scene);
        contacts_file.finish();
        if (!json.is_nowhere())
            json.replace(
                cluster_json(result, run_facts(session.device(), invocation.words), mpi_version())
                    .dump(1) +
                "\n");
        if (!common.quiet)
            std::cout << cluster_table(result, common.wide ? 0 : terminal_width(STDOUT_FILENO));
        return result.check.verdict == Check::Verdict::differs ? 1 : 0;
    }

    ClusterTask task_;
    CellChoice choice_;
    unsigned ranks_ = 0, simulated_ = 0;
    std::string partition_ = "rcb", check_ = "auto";
    std::string json_, pairs_, contacts_, frames_;
};

}  // namespace

extern const CommandEntry cluster_command = {
    "cluster",
    measuring,
    "Find the pairs of one scene on several devices, by MPI, and compare them with those of one",
    "Each rank has a part of the scene and builds a tree over it. Triangles that meet another "
    "rank's "
    "boxes are sent there, so that every pair is found once. Under mpirun or Slurm the ranks are "
    "theirs; otherwise mpirun is started on this host.",
    {{"bvhbench cluster torus:2880000 --ranks 4", "four devices of this host"},
     {"bvhbench cluster bunny --ranks 2 --share-devices --partition curve --pairs pairs.csv",
      "a test on one device"}},
    "docs/cluster.md",
    make_command<Cluster>};

}  // namespace bvhbench
