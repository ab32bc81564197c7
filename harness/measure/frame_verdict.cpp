// SPDX-License-Identifier: MIT
#include "harness/measure/frame_verdict.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "collide/narrow/narrow_methods.h"
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/swept_reference.h"
#include "geometry/hash.h"
#include "geometry/host_memory.h"
#include "harness/measure/device_verdict.h"

namespace bvhbench {
namespace {

/// Writes how far the times of some contacts between two frames are before the exact ones. None may be later.
void judge_times(const Pipeline& pipeline, const Input& input, double separation, Cell& cell)
{
    const PairList contacts(pipeline.contacts());
    const std::vector<float> times = pipeline.impact_times();
    const std::size_t step = contacts.size() / 1000 + 1;  // at most 1,000, spread over all
    std::vector<Pair> some;
    std::vector<double> gaps;
    for (std::size_t k = 0; k < contacts.size(); k += step)
        some.push_back(contacts.pairs()[k]);
    const std::vector<std::optional<ImpactTime>> right = impact_times(input, some, separation);
    for (std::size_t k = 0; k < some.size(); ++k)
        if (right[k] && right[k]->no_later <= 1)
            gaps.push_back(right[k]->no_later - times[k * step]);
    if (gaps.empty())
        return;
    std::ranges::sort(gaps);
    if (gaps.front() < 0)
        cell.check.find_wrong("a touch is said to be later than it is");
    cell.counters["gap_median"] = gaps[gaps.size() / 2];
    cell.counters["gap_99_percent"] = gaps[gaps.size() * 99 / 100];
}

}  // namespace

/// The pairs or contacts that a pipeline found. They are kept only if their hash differs from that of the oracle's list.
class FrameVerdict::FoundList {
public:
    FoundList(std::vector<Pair> found, const Expected& expected, const FrameOfPipelines& frame)
        : expected_(expected), frame_(frame)
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
    void add_differences(const std::string& what, Check& check) const
    {
        if (!own_)
            return;
        const AnswerFacts& expected = expected_.list().facts;
        check.find_wrong(
            "the oracle has " + std::to_string(expected.set.count) + ' ' + what + " of the hash " +
            hex(expected.file_hash) +
            examples(*own_, expected_.list().list, doubled_, frame_.input, frame_.file_faces) +
            "; `collide --" + what + " FILE` writes all that were found");
    }

    /// Writes the hash of the list with triangles numbered as in the scene's file. Returns that list if it is wanted, else none.
    PairList in_file(std::optional<std::uint64_t>& hash) const
    {
        if (!own_ && !frame_.wants_lists) {
            hash = expected_.facts().file_hash;
            return {};
        }
        PairList numbered =
            own_ ? renumbered(*own_, frame_.file_faces) : expected_.list().in_file();
        hash = own_ ? numbered.hash() : expected_.list().facts.file_hash;
        return numbered;
    }

private:
    const Expected& expected_;
    const FrameOfPipelines& frame_;
    std::optional<PairList> own_;  ///< if it is not the oracle's
    std::vector<Pair> doubled_;    ///< some that were found more than once
};

namespace {

/// Counts the errors of what may be found besides what is right: contacts of a narrow phase that is not exact, or pairs of boxes that were
/// rounded outward. None may be missed or be found twice, unless it `may_miss`. The verdict becomes `counted` if they are the answer, and
/// stays if they are candidates.
void check_inexact(const PairList& found, const Answer& expected, const std::string& what,
                   bool may_miss, bool is_answer, Cell& cell)
{
    Differences wrong = count_errors(found, expected.list, cell, what == "pairs" ? "pairs_" : "");
    if (cell.separation) {
        for (const Pair unknown : expected.uncertain.pairs())
            wrong.false_ones -= std::ranges::binary_search(found.pairs(), unknown) ? 1 : 0;
        cell.counters["false_count"] = static_cast<double>(wrong.false_ones);
        cell.counters["uncertain_count"] = static_cast<double>(expected.uncertain.size());
    }
    if (!may_miss && (wrong.missed > 0 || found.surplus() > 0))
        cell.check.find_wrong(std::to_string(found.surplus()) + ' ' + what + " were found twice, " +
                              std::to_string(wrong.missed) + " missed");
    if (!is_answer)
        return;
    if (cell.check.verdict == Check::Verdict::agrees)
        cell.check.verdict = Check::Verdict::counted;
    cell.check.detail += (cell.check.detail.empty() ? "" : "; ") + wrong.text(what);
}

}  // namespace

Differences count_errors(const PairList& found, const PairList& right, Cell& cell,
                         const std::string& of)
{
    const Differences wrong = differences(found, right);
    cell.counters["missed_" + of + "count"] = static_cast<double>(wrong.missed);
    cell.counters["false_" + of + "count"] = static_cast<double>(wrong.false_ones);
    return wrong;
}

void FrameVerdict::require_memory(const ColliderChoice& choice)
{
    const std::size_t bytes = find_collider(choice.name).host_bytes * frame_.input.triangle_count();
    if (bytes == 0)
        return;
    require_host_memory("collider " + choice.name, bytes);
    const std::uint64_t count = oracle_.pairs(choice).facts().set.count;
    require_host_memory("collider " + choice.name + " for " + std::to_string(count) + " pairs",
                        bytes + 4 * sizeof(Pair) * count);
}

void FrameVerdict::judge(Pipeline& pipeline, Cell& cell, Found& found)
{
    cell.check = {.verdict = Check::Verdict::agrees};
    found = {.scene = found.scene};
    (frame_.input.is_swept() ? cell.separation : cell.within_distance) = cell.collider.distance;
    if (pipeline.has_pairs() && !cell.collider.distance)  // else they are of padded boxes
        judge_pairs(pipeline, cell, found);
    if (cell.collider.first)
        judge_first(pipeline, cell, found);
    else if (pipeline.has_contacts())
        judge_contacts(pipeline, cell, found);
    if (frame_.wants_lists)
        found.times = pipeline.impact_times();
    if (frame_.input.is_swept() && pipeline.collider().finds_contacts())
        found.times.resize(found.contacts.size());  // it gives none: 0 is before all of them
    if (frame_.judge_more)
        frame_.judge_more(found, cell);
}

void FrameVerdict::judge_pairs(Pipeline& pipeline, Cell& cell, Found& found)
{
    constexpr double many = 1 << 24;  // fewer are copied to the host and hashed in 0.1 s
    // They are a device's, exact, and nobody wants the list.
    const bool by_device = !pipeline.collider().is_on_host() && !frame_.wants_lists &&
                           cell.features.pairs.empty() &&
                           !widens_boxes(cell.builder, cell.collider);
    try {
        const Expected& expected = oracle_.pairs(cell.collider);
        if (by_device && cell.counters.at("pairs_count") >= many &&
            facts_on_device(session_, pipeline) == expected.facts().set) {
            cell.check.against = pairs_oracle;
            cell.check.pairs_hash = expected.facts().file_hash;
        } else {  // a difference counts only if the list has it too
            judge_pairs_by_list(pipeline, expected, cell, found);
        }
    } catch (const Unavailable&) {  // the host cannot list them
        if (!by_device)
            throw;
        cell.check = verdict_of_devices(session_, pipeline, cell.collider, frame_.input);
    }
}

void FrameVerdict::judge_pairs_by_list(const Pipeline& pipeline, const Expected& expected,
                                       Cell& cell, Found& found) const
{
    const FoundList pairs(pipeline.pairs(), expected, frame_);
    cell.check.against = pairs_oracle;
    if (widens_boxes(cell.builder, cell.collider))
        check_inexact(pairs.list(), expected.list(), "pairs", false, !pipeline.has_contacts(),
                      cell);
    else
        pairs.add_differences("pairs", cell.check);
    if (!cell.features.pairs.empty())
        count_errors(pairs.list(), expected.list().list, cell);
    found.pairs = pairs.in_file(cell.check.pairs_hash);
}

/// Judges an answer that is any contact. Its pair is recorded and has no hash, as the next sample may find another.
void FrameVerdict::judge_first(const Pipeline& pipeline, Cell& cell, Found& found)
{
    const PairList answer(pipeline.contacts());
    found.contacts = renumbered(answer, frame_.file_faces);
    cell.first_contact.emplace();
    for (const Pair pair : found.contacts.pairs())
        cell.first_contact->assign({pair.a, pair.b});
    if (!has_exact_reference) {
        cell.check.verdict = Check::Verdict::not_checked;
        cell.check.detail = "contacts: built without CGAL";
        return;
    }
    cell.check.against = "CGAL";
    const Expected& expected = oracle_.contacts(cell.collider);
    if (answer.size() == 0 && expected.facts().set.count > 0)
        cell.check.find_wrong("no contact was found, and the oracle has " +
                              std::to_string(expected.facts().set.count));
    if (answer.size() > 0 && differences(answer, expected.list().list).false_ones > 0)
        cell.check.find_wrong("the pair that was found is no contact of the oracle's");
}

void FrameVerdict::judge_contacts(const Pipeline& pipeline, Cell& cell, Found& found)
{
    Check& check = cell.check;
    if (!has_exact_reference) {
        if (check.verdict == Check::Verdict::agrees) {
            check.verdict = Check::Verdict::not_checked;
            check.detail = "contacts: built without CGAL";
        }
        found.contacts = renumbered(PairList(pipeline.contacts()), frame_.file_faces);
        check.contacts_hash = found.contacts.hash();
        return;
    }
    check.against += check.against.empty() ? "CGAL" : ", CGAL";
    const Expected& expected = oracle_.contacts(cell.collider);
    const FoundList contacts(pipeline.contacts(), expected, frame_);
    const bool is_swept = frame_.input.is_swept();
    const std::string& narrow = cell.collider.narrow;  // "none" of --within
    const bool own = pipeline.collider().finds_contacts();
    if (own ? !is_swept : narrow == "none" || find_narrow_method(narrow).is_exact)
        contacts.add_differences("contacts", check);
    else
        check_inexact(contacts.list(), expected.list(), "contacts",
                      !own && !find_narrow_method(narrow).misses_none(), true, cell);
    found.contacts = contacts.in_file(check.contacts_hash);
    if (const std::vector<double> off = pipeline.distance_errors(frame_.input); !off.empty()) {
        cell.counters["distance_error_median"] = off[off.size() / 2];
        cell.counters["distance_error_most"] = off.back();
    }
    if (is_swept && !own)
        judge_times(pipeline, frame_.input, cell.collider.distance.value_or(0), cell);
    if (!is_swept && !cell.collider.distance && contacts.is_right())
        cell.counters["touching_count"] = static_cast<double>(expected.facts().touching);
}

}  // namespace bvhbench
