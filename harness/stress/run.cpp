// SPDX-License-Identifier: MIT
#include "harness/stress/run.h"

#include <algorithm>
#include <future>
#include <map>
#include <set>
#include <thread>

#include "builders/spell_out.h"
#include "geometry/host_memory.h"
#include "harness/base/failure.h"
#include "harness/base/progress.h"
#include "harness/stress/run.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;
using Kind = StressCell::Kind;

/// A tree past 2^24 leaves, judged on the host while others are built.
struct LargeTree {
    Findings findings;
    std::uint64_t hash = 0;
};

std::future<LargeTree> begin_large_build(Session& session, const Input& input, StressCell& cell)
{
    HostTree tree;
    cell.findings = settled(session, false, [&] {
        const auto builder = make_builder({.name = cell.system}, session.programs());
        BuiltOnce built = built_once(session, *builder, find_builder(cell.system), input);
        tree = std::move(built.tree);
        return built.findings;
    });
    return std::async(std::launch::async, [&input, tree = std::move(tree)] {
        return tree.nodes.empty()
                   ? LargeTree{}
                   : LargeTree{judge_tree(tree, input.points, input.faces), tree_hash(tree)};
    });
}

class Run {
public:
    Run(Session& session, const StressTask& task, const std::function<void(StressCell&&)>& add)
        : session_(session), task_(task), add_(add)
    {}

    /// What stops all systems, such as a scene that the device has no room for, is a finding too.
    void over(const StressPart& part)
    {
        StressCell place;
        place.family = part.family, place.scene = part.scene.name;
        guarded(place, [&] {
            if (part.scene.is_large)
                build_large(place, part.scene);
            judge_all(part);
        });
    }

private:
    bool guarded(StressCell cell, const std::function<void()>& work)
    {
        const std::string failure = reason_of_failure(work);
        if (failure.empty())
            return true;
        session_.renew_queue();
        cell.system = "device", cell.kind = Kind::host, cell.library.clear();
        cell.findings = {{Invariant::ends, {broken, 1, 1, 0, failure}}};
        add_(std::move(cell));
        return false;
    }

    void judge_all(const StressPart& part)
    {
        std::vector<StressSystem> here, beside;
        for (StressSystem one : *part.systems) {
            one.cell.family = part.family, one.cell.scene = part.scene.name;
            if (task_.wants(one.cell))
                (one.cell.kind == Kind::library ? beside : here).push_back(std::move(one));
        }
        if (here.empty() && beside.empty())
            return;
        SceneUnderStress scene(session_, part.scene.make, task_.size.seed);
        const auto triangles = static_cast<std::int64_t>(scene.scene().mesh.faces.size());
        const auto libraries = std::async(std::launch::async, [&] {  // which need no device
            for (StressSystem& one : beside)
                one.cell.findings = one.judge(scene).value();
        });
        judge_each(here, scene, triangles);
        libraries.wait();
        for (StressSystem& one : beside) {
            one.cell.triangles = triangles;
            add_(std::move(one.cell));
        }
    }

    void judge_each(std::vector<StressSystem>& all, SceneUnderStress& scene, std::int64_t triangles)
    {
        std::set<Kind> stopped;  // what fails for one of a kind fails for the others
        for (auto& [cell, judge] : all) {
            if (stopped.contains(cell.kind))
                continue;
            cell.triangles = triangles;
            std::optional<Findings> findings;
            if (!guarded(cell, [&] { findings = judge(scene); }))
                stopped.insert(cell.kind);
            if (!findings)
                continue;
            cell.findings = std::move(*findings);
            add_(std::move(cell));
        }
    }

    /// Every builder over a scene past 2^24 leaves, as many trees at once as there are cores and memory to check them with.
    void build_large(const StressCell& place, const StressCase& one)
    {
        std::vector<StressCell> cells;
        for (const BuilderChoice& builder : device_builders(session_)) {
            StressCell cell = place;
            cell.system = builder.name;
            if (task_.wants(cell))
                cells.push_back(std::move(cell));
        }
        if (cells.empty())
            return;
        SceneUnderStress scene(session_, one.make, task_.size.seed);
        const Input& input = scene.input();
        const std::size_t most =
            std::clamp<std::size_t>(host_memory_left() / 2 / check_bytes(input.triangle_count()), 1,
                                    std::max(1u, std::thread::hardware_concurrency()));
        std::map<std::string_view, std::uint64_t> hashes;  // of trees, by the reference's name
        for (std::size_t first = 0; first < cells.size(); first += most) {
            const auto batch =
                std::span(cells).subspan(first, std::min(most, cells.size() - first));
            std::vector<std::future<LargeTree>> trees;
            for (StressCell& cell : batch)
                trees.push_back(begin_large_build(session_, input, cell));
            for (std::size_t k = 0; k < batch.size(); ++k) {
                const LargeTree tree = trees[k].get();
                StressCell& cell = batch[k];
                cell.triangles = input.triangle_count();
                join(cell.findings, tree.findings);
                const std::string_view oracle = find_builder(cell.system).oracle;
                if (!oracle.empty() && !tree.findings.empty() &&
                    hashes.try_emplace(oracle, tree.hash).first->second != tree.hash)
                    cell.findings[Invariant::layout] = {
                        broken, 1, 0, 0,
                        "it is another tree than another builder's, which must leave the same"};
                add_(std::move(cell));
            }
        }
    }

    Session& session_;
    const StressTask& task_;
    const std::function<void(StressCell&&)>& add_;
};

}  // namespace

void stress_all(Session& session, const StressTask& task,
                const std::function<void(StressCell&&)>& add)
{
    const std::vector<StressPart> parts = stress_parts(session, task.size);
    Progress progress(parts.size());
    Run run(session, task, add);
    for (const StressPart& part : parts) {
        progress.step(part.family + ", " + part.scene.name);
        run.over(part);
    }
}

}  // namespace bvhbench
