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
    std::vector<const StressSystem*> here, beside;
    for (const StressSystem& one : part.systems)
        if (passes(task.filter, part.family + '/' + part.scene.name + '/' + one.name))
            (one.kind == Kind::library ? beside : here).push_back(&one);
    if (here.empty() && beside.empty())
        return;
    SceneUnderStress scene{
        session, part.scene.name, task.size.seed, part.repeats, {part.scene.make}};
    const auto triangles = static_cast<std::int64_t>(scene.scene().mesh.faces.size());
    const auto cell_of = [&](const StressSystem& one, Findings findings) {
        return StressCell{part.family, part.scene.name, triangles,          one.name,
                          one.kind,    one.library,     std::move(findings)};
    };
    auto libraries = std::async(std::launch::async, [&] {  // libraries need no device
        std::vector<StressCell> cells;
        for (const StressSystem* one : beside)
            cells.push_back(cell_of(*one, one->judge(scene).value()));
        return cells;
    });
    std::set<Kind> stopped;
    for (const StressSystem* one : here) {
        if (stopped.contains(one->kind))
            continue;
        std::optional<Findings> findings;
        if (!guarded(session, cell_of(*one, {}), add, [&] { findings = one->judge(scene); }))
            stopped.insert(one->kind);
        if (findings)
            add(cell_of(*one, std::move(*findings)));
    }
    for (StressCell& cell : libraries.get())
        add(std::move(cell));
}

}  // namespace

void stress_all(Session& session, const StressTask& task, const AddCell& add)
{
    const std::vector<StressPart> parts = stress_parts(session, task.size);
    Progress progress(parts.size());
    for (const StressPart& part : parts) {
        progress.step(part.family + ", " + part.scene.name);
        guarded(session, {.family = part.family, .scene = part.scene.name}, add,
                [&] { judge_part(session, task, part, add); });
    }
}

}  // namespace bvhbench
