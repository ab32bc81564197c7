// SPDX-License-Identifier: MIT
#include "harness/measure/cluster.h"

#include <re2/re2.h>

#include <filesystem>

#include "cluster/mpi_ranks.h"
#include "geometry/error.h"
#include "harness/base/failure.h"
#include "process/child.h"
#include "process/mpirun.h"
#include "process/temporary_folder.h"

namespace bvhbench {
namespace {

/// Returns how NVIDIA's devices are linked, as nvidia-smi prints it; empty where it cannot tell.
std::string topology()
{
    constexpr double limit_s = 60;
    ProcessEnd end{.code = 1};
    reason_of_failure([&] {
        end = run_process({"nvidia-smi", "topo", "-m"}, limit_s, "LC_ALL=C");
    });
    if (end.how != ProcessEnd::How::exited || end.code != 0)
        return {};
    RE2::GlobalReplace(&end.output, "\x1b\\[[\\d;]*m|\\s+$", "");
    return end.output;
}

}  // namespace

Json cell_by_ranks(const ClusterTask& task, const CommonOptions& common)
{
    if (const std::string why = mpi_absent(); !why.empty())
        throw Unavailable(why);
    const TemporaryFolder folder("ranks");
    const std::filesystem::path file = folder.path / "cell.json";
    std::vector<std::string> words = task.words;
    words.insert(words.end(), common.given.begin(), common.given.end());
    words.insert(words.end(),
                 {"--samples", std::to_string(task.samples), "--json", file, "--quiet"});
    const RanksEnd end = run_ranks(task.ranks, words, 0, common.time_limit_s);
    if (!std::filesystem::exists(file)) {
        const std::string why = !end.sentence.empty()
                                    ? end.sentence
                                    : "ranks ended with exit code " + std::to_string(end.code);
        if (end.code == 2)
            throw BadUsage(why);
        throw Unavailable(why);
    }
    Json cell = Json::parse(file_text(file, "the file of the ranks"))["cells"][0];
    cell["experiment"] = task.experiment;
    return cell;
}

Json with_cluster_facts(Json run)
{
    put_if(run["libraries"], "MPI", mpi_version());
    put_if(run, "topology", topology());
    return run;
}

}  // namespace bvhbench
