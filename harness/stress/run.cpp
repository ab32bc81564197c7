// SPDX-License-Identifier: MIT
#include "harness/stress/run.h"

#include <future>
#include <set>

#include "harness/base/failure.h"
#include "harness/base/terminal.h"

namespace bvhbench {
namespace {

using Kind = StressCell::Kind;
using AddCell = std::function<void(StressCell&&)>;

/// Runs `work` and returns true if it succeeds. A failure, such as too little device memory for the scene, stops all systems of
/// the kind; it is added as one cell in place of theirs.
bool guarded(Session& session, StressCell cell, const AddCell& add,
             const std::function<void()>& work)
{
    const std::string failure = reason_of_failure(work);
    if (failure.empty())
        return true;
    session.renew_queue();
    cell.system = "device", cell.kind = Kind::host, cell.library.clear();
    cell.findings = {{Invariant::ends, {Finding::Verdict::broken, 1, 1, 0, failure}}};
    add(std::move(cell));
    return false;
}

void judge_part(Session& session, const StressTask& task, const StressPart& part,
                const AddCell& add)
{
    std::vector<StressSystem> here, beside;
    for (StressSystem one : part.systems) {
        one.cell.family = part.family, one.cell.scene = part.scene.name;
        if (task.wants(one.cell))
            (one.cell.kind == Kind::library ? beside : here).push_back(std::move(one));
    }
    if (here.empty() && beside.empty())
        return;
    SceneUnderStress scene(session, part.scene.make, task.size.seed);
    for (std::vector<StressSystem>* systems : {&here, &beside})
        for (StressSystem& one : *systems)
            one.cell.triangles = static_cast<std::int64_t>(scene.scene().mesh.faces.size());
    const auto libraries = std::async(std::launch::async, [&] {  // libraries need no device
        for (auto& [cell, judge] : beside)
            cell.findings = judge(scene).value();
    });
    std::set<Kind> stopped;
    for (auto& [cell, judge] : here) {
        if (stopped.contains(cell.kind))
            continue;
        std::optional<Findings> findings;
        if (!guarded(session, cell, add, [&] { findings = judge(scene); }))
            stopped.insert(cell.kind);
        if (!findings)
            continue;
        cell.findings = std::move(*findings);
        add(std::move(cell));
    }
    libraries.wait();
    for (StressSystem& one : beside)
        add(std::move(one.cell));
}

}  // namespace

void stress_all(Session& session, const StressTask& task, const AddCell& add)
{
    const std::vector<StressPart> parts = stress_parts(session, task.size);
    Progress progress(parts.size());
    for (const StressPart& part : parts) {
        progress.step(part.family + ", " + part.scene.name);
        StressCell place;
        place.family = part.family, place.scene = part.scene.name;
        guarded(session, place, add, [&] { judge_part(session, task, part, add); });
    }
}

}  // namespace bvhbench
