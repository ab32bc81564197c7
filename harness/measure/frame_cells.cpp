// SPDX-License-Identifier: MIT
#include "harness/measure/collide.h"

#include <chrono>
#include <future>
#include <map>
#include <memory>

#include "builders/box_format.h"
#include "collide/narrow/narrow_methods.h"
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/sweep.h"
#include "geometry/hash.h"
#include "geometry/host_memory.h"
#include "harness/judge/pair_counts.h"
#include "harness/measure/engine.h"
#include "harness/session/watchdog.h"

namespace bvhbench {
namespace {

/// Computes the pairs and contacts of a frame on another core, each when first asked for.
class FrameOracle {
public:
    /// `note` receives a line of progress each second of waiting.
    FrameOracle(const Input& input, std::function<void(const std::string&)> note)
        : input_(input), note_(std::move(note))
    {}

    /// Starts computing the pairs. Nothing may be timed before wait().
    void begin(const ColliderChoice& choice) { entry(choice); }

    /// Blocks until all pairs that were begun are computed.
    void wait() const
    {
        for (const auto& [choice, one] : entries_)
            wait_for(one.pairs);
    }

    const PairList& pairs(const ColliderChoice& choice)
    {
        return wait_for(entry(choice).pairs).get();
    }

    const PairList& contacts(const ColliderChoice& choice)
    {
        Later& found = entry(choice).contacts;
        if (!found.valid())
            found = std::async(std::launch::async, [this, keep_adjacent = choice.keep_adjacent,
                                                    of = &pairs(choice)] {
                return intersecting_pairs(input_.points, input_.faces, *of, keep_adjacent);
            });
        return wait_for(found).get();
    }

private:
    using Later = std::shared_future<PairList>;
    struct Entry {
        Later pairs, contacts;
    };

    const Later& wait_for(const Later& later) const
    {
        for (int seconds = 1; later.wait_for(std::chrono::seconds(1)) != std::future_status::ready;
             ++seconds) {
            if (note_)
                note_("the oracle is checking, " + std::to_string(seconds) + " s");
        }
        return later;
    }

    Entry& entry(const ColliderChoice& choice)
    {
        const std::pair asked(choice.among, choice.keep_adjacent);
        const auto [at, is_new] = entries_.try_emplace(asked);
        if (is_new)
            at->second.pairs = std::async(std::launch::async, [this, asked] {
                require_host_memory("checking the pairs", input_.faces.size() * sizeof(Aabb));
                return touching_pairs(leaf_boxes(input_), input_.faces, asked.second,
                                      input_.objects, asked.first);
            });
        return at->second;
    }

    const Input& input_;
    std::function<void(const std::string&)> note_;
    std::map<std::pair<Among, bool>, Entry>
        entries_;  ///< by the kind of pairs, and whether adjacent ones are kept
};

/// Compares a list to the oracle's and adds differences to the check.
void hold(const PairList& found, const PairList& expected, const std::string& what,
          std::span<const uint> file_faces, Check& check)
{
    if (found.surplus() > 0)
        check.find_wrong(std::to_string(found.surplus()) + ' ' + what + " were found twice");
    else if (found != expected)
        check.find_wrong("the oracle has " + std::to_string(expected.size()) + ' ' + what +
                         " of the hash " + hex(renumbered(expected, file_faces).hash()));
}

/// Counts what is missed and what is false, and writes both to the cell's counters. `of` is part of their names.
Differences count_errors(const PairList& found, const PairList& expected, const std::string& of,
                         Cell& cell)
{
    const Differences wrong = differences(found, expected);
    cell.counters["missed_" + of + "count"] = static_cast<double>(wrong.missed);
    cell.counters["false_" + of + "count"] = static_cast<double>(wrong.false_ones);
    return wrong;
}

/// Counts the errors of a narrow phase that is not exact.
void hold_inexact(const PairList& found, const PairList& expected, Cell& cell)
{
    const Differences wrong = count_errors(found, expected, "", cell);
    if (cell.check.verdict == Check::Verdict::agrees)
        cell.check.verdict = Check::Verdict::counted;
    cell.check.detail += wrong.text("contacts");
}

/// Checks pairs of boxes that were rounded outward: none of the oracle's may be missing, more are allowed. The verdict becomes
/// `counted` if the pairs are the answer, and stays if they are candidates for a narrow phase.
void hold_candidates(const PairList& found, const PairList& expected, bool is_answer, Cell& cell)
{
    const Differences wrong = count_errors(found, expected, "pairs_", cell);
    if (found.surplus() > 0 || wrong.missed > 0) {
        cell.check.find_wrong(std::to_string(found.surplus()) + " pairs were found twice, " +
                              std::to_string(wrong.missed) + " missed");
    } else if (is_answer) {
        cell.check.verdict = Check::Verdict::counted;
        cell.check.detail = wrong.text();
    }
}

/// Judges what a pipeline found and writes the verdict to the cell.
void judge(const Pipeline& pipeline, Cell& cell, FrameOracle& oracle, const FrameOfPipelines& frame,
           Found& found)
{
    const ColliderChoice& choice = cell.collider;
    Check& check = cell.check;
    check = {.verdict = Check::Verdict::agrees, .against = {}, .detail = {}};
    found = {.scene = found.scene};
    if (pipeline.has_pairs()) {
        PairList pairs = pipeline.pairs();
        check.against = "brute";
        if (find_box_format(cell.builder.boxes).has_cells())
            hold_candidates(pairs, oracle.pairs(choice), !pipeline.has_contacts(), cell);
        else
            hold(pairs, oracle.pairs(choice), "pairs", frame.file_faces, check);
        if (!cell.swept.pairs.empty())
            count_errors(pairs, oracle.pairs(choice), "", cell);
        found.pairs = renumbered(std::move(pairs), frame.file_faces);
        check.pairs_hash = found.pairs.hash();
    }
    if (pipeline.has_contacts()) {
        PairList contacts = pipeline.contacts();
        if (has_exact_reference) {
            check.against += check.against.empty() ? "CGAL" : ", CGAL";
            const bool by_collider = pipeline.collider().finds_contacts();
            if (by_collider || find_narrow_method(choice.narrow).is_exact)
                hold(contacts, oracle.contacts(choice), "contacts", frame.file_faces, check);
            else
                hold_inexact(contacts, oracle.contacts(choice), cell);
        } else if (check.verdict == Check::Verdict::agrees) {
            check.verdict = Check::Verdict::not_checked;
            check.detail = "contacts: built without CGAL";
        }
        found.contacts = renumbered(std::move(contacts), frame.file_faces);
        check.contacts_hash = found.contacts.hash();
    }
    if (frame.judge_more)
        frame.judge_more(found, cell);
}

/// Throws if the host lacks memory for a library's trees and for its pairs, which the oracle has counted. The pairs are stored
/// twice, in lists that grow by doubling.
void require_memory(const ColliderChoice& choice, std::size_t triangles, FrameOracle& oracle)
{
    const std::size_t bytes = find_collider(choice.name).host_bytes;
    if (bytes == 0)
        return;
    require_host_memory("collider " + choice.name, bytes * triangles);
    const std::size_t count = oracle.pairs(choice).size();
    require_host_memory("collider " + choice.name + " for " + std::to_string(count) + " pairs",
                        bytes * triangles + 4 * sizeof(Pair) * count);
}

/// Creates the pipeline if it does not exist and runs the frame once, so that the frame can be timed. Returns the stages.
std::vector<StageTime> settle(Session& session, Running& one, const FrameOfPipelines& frame,
                              Cell& cell)
{
    const watchdog::Watch watch;
    if (one.pipeline == nullptr)
        one.pipeline =
            std::make_unique<Pipeline>(session, cell.builder, cell.collider, frame.input);
    if (!one.pipeline->collider().needs_tree())
        cell.builder = {.name = "none"};
    one.pipeline->begin_frame(frame.motions);
    std::vector<StageTime> stages;
    cell.first.run_ns = host_ns([&] { stages = one.pipeline->settle(frame.input); });
    return stages;
}

}  // namespace

std::vector<Cell> run_frame(Session& session, const CollideTask& task, std::span<Running> all,
                            const FrameOfPipelines& frame, int& order, Found& found)
{
    const Input& input = frame.input;
    FrameOracle oracle(input, task.note);
    oracle.begin(all.front().choice.collider);  // runs while the first pipeline settles
    Engine engine(session, {task.samples, task.warm_up, task.sampling}, order);
    std::vector<Subject> subjects(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        Running& one = all[k];
        Subject& subject = subjects[k];
        subject = {.cell = planned_cell(task, one.choice),
                   .number = frame.number + '/' + std::to_string(k)};
        Cell& cell = subject.cell;
        cell.scene = frame.scene;
        cell.swept = frame.swept;
        if (one.status == Cell::Status::measured && one.pipeline == nullptr)
            if (one.reason = frame.contest.why_not(cell); !one.reason.empty())
                one.status = Cell::Status::skipped;
        if (one.status != Cell::Status::measured) {
            engine.refuse(subject, one.status, one.reason);
            continue;
        }
        engine.settle(subject, [&] {
            require_memory(cell.collider, input.triangle_count(), oracle);
            subject.settled = settle(session, one, frame, cell);
            cell.counters = one.pipeline->counters();
            judge(*one.pipeline, cell, oracle, frame, found);
        });
        subject.once = [&] {
            const watchdog::Watch watch;
            return one.pipeline->once(input);
        };
        // Another pipeline may have used the same builder's tree since the last sample, so the frame runs once more.
        subject.judge_again = [&] {
            one.pipeline->once(input);
            judge(*one.pipeline, cell, oracle, frame, found);
            frame.contest.count_areas(*one.pipeline, input, cell);
        };
        if (engine.look(subject, frame.contest))
            one.pipeline.reset();  // it is far behind; frees its memory
    }
    oracle.wait();  // needed even if no pipeline has asked the oracle
    engine.sample(subjects);
    std::vector<Cell> cells;
    for (std::size_t k = 0; k < all.size(); ++k) {
        Cell& cell = subjects[k].cell;
        all[k].status = cell.status;
        all[k].reason = cell.reason;
        cells.push_back(std::move(cell));
    }
    frame.contest.end_frame(cells);
    for (std::size_t k = 0; k < all.size(); ++k)
        if (std::string why = frame.contest.why_lost(k); !why.empty())
            all[k] = {
                .choice = all[k].choice, .status = Cell::Status::skipped, .reason = std::move(why)};
    return cells;
}

}  // namespace bvhbench
