// SPDX-License-Identifier: MIT
#include "harness/measure/collide.h"

#include <memory>
#include <optional>

#include "builders/box_format.h"
#include "collide/narrow/narrow_methods.h"
#include "collide/oracles/exact_reference.h"
#include "geometry/hash.h"
#include "geometry/host_memory.h"
#include "harness/judge/pair_counts.h"
#include "harness/measure/device_verdict.h"
#include "harness/measure/engine.h"
#include "harness/measure/frame_oracle.h"
#include "process/watchdog.h"

namespace bvhbench {
namespace {

/// The pairs or contacts that a pipeline found. They are kept only if their hash differs from that of the oracle's list.
class FoundList {
public:
    FoundList(std::vector<Pair> found, const Expected& expected) : expected_(expected)
    {
        const PairFacts facts = facts_of(found);
        // Facts from an earlier run may be wrong, so a difference counts only if the list has it too.
        if (facts != expected.facts().set && facts != expected.list().facts.set) {
            doubled_ = doubled_pairs(found);
            own_.emplace(std::move(found));
        }
    }

    bool is_right() const { return !own_; }
    const PairList& list() const { return own_ ? *own_ : expected_.list().list; }

    /// Adds differences from the oracle's list to the check.
    void add_differences(const std::string& what, Check& check, const FrameOfPipelines& frame) const
    {
        if (!own_)
            return;
        const AnswerFacts& expected = expected_.list().facts;
        check.find_wrong(
            "the oracle has " + std::to_string(expected.set.count) + ' ' + what + " of the hash " +
            hex(expected.file_hash) +
            examples(*own_, expected_.list().list, doubled_, frame.input, frame.file_faces) +
            "; `collide --" + what + " FILE` writes all that were found");
    }

    /// Writes the hash of the list with triangles numbered as in the scene's file. Returns that list if it is wanted, else none.
    PairList in_file(const FrameOfPipelines& frame, std::optional<std::uint64_t>& hash) const
    {
        if (!own_ && !frame.wants_lists) {
            hash = expected_.facts().file_hash;
            return {};
        }
        PairList numbered = own_ ? renumbered(*own_, frame.file_faces) : expected_.list().in_file();
        hash = own_ ? numbered.hash() : expected_.list().facts.file_hash;
        return numbered;
    }

private:
    const Expected& expected_;
    std::optional<PairList> own_;  ///< if it is not the oracle's
    std::vector<Pair> doubled_;    ///< some that were found more than once
};

/// Counts what is missed and what is false, and writes both to the cell's counters. `of` is part of their names.
Differences count_errors(const PairList& found, const PairList& expected, const std::string& of,
                         Cell& cell)
{
    const Differences wrong = differences(found, expected);
    cell.counters["missed_" + of + "count"] = static_cast<double>(wrong.missed);
    cell.counters["false_" + of + "count"] = static_cast<double>(wrong.false_ones);
    return wrong;
}

/// Counts the errors of a narrow phase that is not exact. One for swept boxes may find what does not touch, and misses nothing.
void check_inexact(const PairList& found, const PairList& expected, bool may_miss, Cell& cell)
{
    const Differences wrong = count_errors(found, expected, "", cell);
    if (!may_miss && (wrong.missed > 0 || found.surplus() > 0))
        cell.check.find_wrong(std::to_string(found.surplus()) + " contacts were found twice, " +
                              std::to_string(wrong.missed) + " missed; ");
    if (cell.check.verdict == Check::Verdict::agrees)
        cell.check.verdict = Check::Verdict::counted;
    cell.check.detail += wrong.text("contacts");
}

/// Checks pairs of boxes that were rounded outward: none of the oracle's may be missing, more are allowed. The verdict becomes
/// `counted` if the pairs are the answer, and stays if they are candidates for a narrow phase.
void check_candidates(const PairList& found, const PairList& expected, bool is_answer, Cell& cell)
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

/// Judges the pairs that a pipeline found by the oracle's list.
void judge_by_list(const Pipeline& pipeline, Cell& cell, const Expected& expected,
                   const FrameOfPipelines& frame, Found& found)
{
    const FoundList pairs(pipeline.pairs(), expected);
    cell.check.against = pairs_oracle;
    if (find_box_format(cell.builder.boxes).has_cells())
        check_candidates(pairs.list(), expected.list().list, !pipeline.has_contacts(), cell);
    else
        pairs.add_differences("pairs", cell.check, frame);
    if (!cell.swept.pairs.empty())
        count_errors(pairs.list(), expected.list().list, "", cell);
    found.pairs = pairs.in_file(frame, cell.check.pairs_hash);
}

/// True if the pairs can be judged without a list of them: they are a device's, exact, and nobody wants the list.
bool needs_no_list(const Pipeline& pipeline, const Cell& cell, const FrameOfPipelines& frame)
{
    return !pipeline.collider().is_on_host() && !frame.wants_lists && cell.swept.pairs.empty() &&
           !find_box_format(cell.builder.boxes).has_cells();
}

/// Judges what a pipeline found and writes the verdict to the cell.
void judge(Session& session, Pipeline& pipeline, Cell& cell, FrameOracle& oracle,
           const FrameOfPipelines& frame, Found& found)
{
    const ColliderChoice& choice = cell.collider;
    Check& check = cell.check;
    check = {.verdict = Check::Verdict::agrees, .against = {}, .detail = {}};
    found = {.scene = found.scene};
    if (pipeline.has_pairs()) {
        constexpr double many = 1 << 24;  // fewer are copied to the host and hashed in 0.1 s
        const bool by_device = needs_no_list(pipeline, cell, frame);
        try {
            const Expected& expected = oracle.pairs(choice);
            if (by_device && cell.counters.at("pairs_count") >= many &&
                facts_on_device(session, pipeline) == expected.facts().set) {
                check.against = pairs_oracle;
                check.pairs_hash = expected.facts().file_hash;
            } else {  // a difference counts only if the list has it too
                judge_by_list(pipeline, cell, expected, frame, found);
            }
        } catch (const Unavailable&) {  // the host cannot list them
            if (!by_device)
                throw;
            check = verdict_of_devices(session, pipeline, choice, frame.input);
        }
    }
    if (pipeline.has_contacts()) {
        if (has_exact_reference) {
            check.against += check.against.empty() ? "CGAL" : ", CGAL";
            const Expected& expected = oracle.contacts(choice);
            const FoundList contacts(pipeline.contacts(), expected);
            const bool by_collider = pipeline.collider().finds_contacts();
            if (by_collider || find_narrow_method(choice.narrow).is_exact)
                contacts.add_differences("contacts", check, frame);
            else
                check_inexact(contacts.list(), expected.list().list, !frame.input.is_swept(), cell);
            found.contacts = contacts.in_file(frame, check.contacts_hash);
            if (!frame.input.is_swept() && contacts.is_right())
                cell.counters["touching_count"] = static_cast<double>(expected.facts().touching);
        } else {
            if (check.verdict == Check::Verdict::agrees) {
                check.verdict = Check::Verdict::not_checked;
                check.detail = "contacts: built without CGAL";
            }
            found.contacts = renumbered(PairList(pipeline.contacts()), frame.file_faces);
            check.contacts_hash = found.contacts.hash();
        }
    }
    if (frame.wants_lists)
        found.times = pipeline.impact_times();
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
    const std::uint64_t count = oracle.pairs(choice).facts().set.count;
    require_host_memory("collider " + choice.name + " for " + std::to_string(count) + " pairs",
                        bytes * triangles + 4 * sizeof(Pair) * count);
}

/// Creates the pipeline if it does not exist and runs the frame once, so that the frame can be timed. Returns the stages.
std::vector<StageTime> prepare(Session& session, PipelineState& one, const FrameOfPipelines& frame,
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
    cell.first.run_ns = host_ns([&] { stages = one.pipeline->prepare(frame.input); });
    return stages;
}

}  // namespace

std::vector<Cell> run_frame(Session& session, const CollideTask& task, std::span<PipelineState> all,
                            const FrameOfPipelines& frame, int& order, Found& found)
{
    const Input& input = frame.input;
    FrameOracle oracle(input, frame.file_faces, frame.note);
    oracle.begin(all.front().choice.collider);  // runs while the first pipeline is prepared
    Engine engine(session, {task.samples, task.warm_up, task.sampling}, order, frame.note);
    std::vector<Measurement> measurements(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        PipelineState& one = all[k];
        Measurement& measurement = measurements[k];
        measurement = {.cell = planned_cell(task, one.choice),
                       .number = frame.number + '/' + std::to_string(k)};
        Cell& cell = measurement.cell;
        cell.scene = frame.scene;
        cell.swept = frame.swept;
        if (one.status == Cell::Status::measured && one.pipeline == nullptr)
            if (one.reason = frame.contest.why_not(cell); !one.reason.empty())
                one.status = Cell::Status::skipped;
        if (one.status != Cell::Status::measured) {
            engine.refuse(measurement, one.status, one.reason);
            continue;
        }
        if (frame.note)
            frame.note(one.choice.collider.name + " over " + one.choice.builder.name + ", cell " +
                           std::to_string(k + 1) + " of " + std::to_string(all.size()),
                       0);
        engine.prepare(measurement, [&] {
            require_memory(cell.collider, input.triangle_count(), oracle);
            measurement.stages_before = prepare(session, one, frame, cell);
            cell.counters = one.pipeline->counters();
            cell.counters.merge(one.pipeline->transfers(input));
            judge(session, *one.pipeline, cell, oracle, frame, found);
        });
        measurement.once = [&] {
            const watchdog::Watch watch;
            return one.pipeline->once(input);
        };
        if (find_collider(one.choice.collider.name).outside != nullptr)
            measurement.no_copies = no_copies_of_outside;
        if (one.pipeline != nullptr && one.pipeline->is_on_device()) {
            measurement.upload = [&] { one.pipeline->upload(input); };
            measurement.read_back = [&] { one.pipeline->read_back(); };
        }
        // Another pipeline may have used the same builder's tree since the last sample, so the frame runs once more.
        measurement.judge_again = [&] {
            one.pipeline->once(input);
            judge(session, *one.pipeline, cell, oracle, frame, found);
            frame.contest.count_areas(*one.pipeline, input, cell);
        };
        if (engine.sample_first(measurement, frame.contest))
            one.pipeline.reset();  // it is far behind; frees its memory
    }
    oracle.wait();  // needed even if no pipeline has asked the oracle
    std::vector<Cell> cells = engine.sample(measurements);
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].status = measurements[k].cell.status;
        all[k].reason = measurements[k].cell.reason;
    }
    frame.contest.end_frame(cells);
    for (std::size_t k = 0; k < all.size(); ++k)
        if (std::string why = frame.contest.why_lost(k); !why.empty())
            all[k] = {
                .choice = all[k].choice, .status = Cell::Status::skipped, .reason = std::move(why)};
    return cells;
}

}  // namespace bvhbench
