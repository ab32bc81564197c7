// SPDX-License-Identifier: MIT
//
// The axis queries: single queries of continuous collision detection, by method, against exact times.
#include <algorithm>

#include "collide/moving/impact_queries.h"
#include "collide/oracles/swept_reference.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/accuracy/axis.h"
#include "harness/accuracy/error_sizes.h"
#include "harness/base/failure.h"
#include "harness/choice/catalog.h"
#include "harness/choice/distance_words.h"
#include "plugins/state.h"
#include "scenes/manifest.h"
#include "scenes/moving_queries.h"

namespace bvhbench {
namespace {

/// A sample answers this many queries or more: sets that are smaller are repeated.
constexpr std::size_t least_queries = 1u << 16;

using Times = std::vector<std::optional<ImpactTime>>;

/// Counts what is wrong with a method's times and how far they are before the right ones, and puts the verdict. The times of a
/// method that misses nothing must be right.
void judge_times(const std::vector<double>& found, const Times& right, bool misses_none, Cell& cell)
{
    double missed = 0, wrong = 0, late = 0, shortened = 0, uncertain = 0;
    std::vector<double> gaps;  // of queries that touch and were found to
    for (std::size_t k = 0; k < found.size(); ++k) {
        const bool touches = right[k].has_value(), is_found = found[k] <= 1;
        if (touches && right[k]->no_later > 1) {
            ++uncertain;
            continue;
        }
        missed += touches && !is_found ? 1 : 0;
        wrong += !touches && is_found ? 1 : 0;
        late += touches && is_found && found[k] > right[k]->no_later ? 1 : 0;
        shortened += std::max(0.0, (touches ? right[k]->no_later : 1) - std::min(found[k], 1.0));
        if (touches && is_found)
            gaps.push_back(std::max(0.0, right[k]->no_later - found[k]));
    }
    std::ranges::sort(gaps);
    cell.counters["missed_count"] = missed;
    cell.counters["false_count"] = wrong;
    cell.counters["late_count"] = late;
    if (cell.separation)
        cell.counters["uncertain_count"] = uncertain;
    cell.counters["gap_median"] = value_at(gaps, 0.5);
    cell.counters["gap_99_percent"] = value_at(gaps, 0.99);
    cell.counters["shortened_mean"] = shortened / static_cast<double>(found.size());
    cell.counters["queries_count"] = static_cast<double>(found.size());
    cell.counters["touching_count"] =
        static_cast<double>(std::ranges::count_if(right, &std::optional<ImpactTime>::has_value));
    judge(cell, "CGAL", misses_none && missed + late > 0,
          "a touch was missed or said to be later than it is");
}

void prepare(Session& session, const QueryMethod& method, const QuerySet& set, const Times& right,
             Measurement& one)
{
    const std::size_t copies = (least_queries + set.queries.size() - 1) / set.queries.size();
    const auto queries = std::make_shared<ImpactQueries>(session.programs(), method,
                                                         one.cell.separation.value_or(0));
    queries->load(set.queries, copies, session.queue());
    one.once = [&session, queries] {
        session.give_head_start();
        queries->query(session.queue());
        return session.queue().finish();
    };
    one.judge_again = [&, queries, copies] {
        judge_times(queries->times(session.queue()), right, method.misses_none(), one.cell);
        one.cell.counters["copies_count"] = static_cast<double>(copies);
        one.cell.counters["cut_short_count"] =
            static_cast<double>(queries->cut_short(session.queue())) / static_cast<double>(copies);
    };
}

void prepare(Session& session, const outside::Offer& offer, const QuerySet& set, const Times& right,
             Measurement& one)
{
    if (one.cell.separation)
        throw BadUsage("a plug-in is not told of a separation");
    const auto state = std::make_shared<outside::State>(offer.library, offer.method, offer.limits);
    state->send_queries(set.queries);
    one.once = [&session, state] {
        state->run("answer", session.queue());
        return session.queue().finish();
    };
    one.judge_again = [&, state] {
        judge_times(state->times(), right, false, one.cell);
        one.cell.counters["copies_count"] = 1;
    };
}

void measure_set(const AxisRun& run, const QuerySet& set, const std::string& name,
                 const std::string& source)
{
    Times right;
    std::optional<double> separation;
    std::vector<AxisMethod> methods;
    const auto add = [&](std::string_view called, const auto& method) {
        if (run.task.wants(name, called))
            methods.push_back({.name = std::string(called), .prepare = [&](Measurement& one) {
                                   one.cell.separation = separation;
                                   prepare(run.session, method, set, right, one);
                               }});
    };
    for (const QueryMethod& method : query_methods())
        add(method.name, method);
    for (const outside::Offer& offer : outside_offers())
        if (offer.method.answers)
            add(offer.method.name, offer);
    if (methods.empty())
        return;
    separation = distance_of(run.task.separation, set.box());
    if (separation == 0.0)
        separation.reset();
    right = impact_times(set.queries, nullptr, separation.value_or(0));
    // As the features of swept boxes: a vertex, an edge and a face are a triangle each.
    SceneFacts facts{.name = name,
                     .triangles = static_cast<std::int64_t>(2 * set.queries.size()),
                     .vertices = static_cast<std::int64_t>(4 * set.queries.size()),
                     .objects = 1,
                     .source = source};
    Hash hash;
    for (const MovingQuery& query : set.queries)
        for (const auto& points : {query.from, query.to})
            hash.values(std::span<const WidePoint>(points));
    facts.content_hash = hash.get();
    for (std::size_t k = 0; k < set.published.size(); ++k)
        if (!separation && right[k].has_value() != (set.published[k] != 0))
            run.session.scenes().tell(name + ": query " + std::to_string(k) + " is published to " +
                                      (right[k] ? "pass, and touches" : "touch, and passes"));
    measure_methods(run, "queries", facts, methods);
}

}  // namespace

void measure_queries(const AxisRun& run)
{
    std::vector<std::string> asked = run.task.scenes;
    if (asked.empty() || asked.front() == quick_scene)
        asked = {"ccd_wang2021", "ccd_scalable"};
    for (const std::string& name : asked) {
        run.progress.note("accuracy, queries: " + name);
        const std::string failure = reason_of_failure([&] {
            if (!has_exact_reference)
                throw BadUsage("built without CGAL, which errors are counted against");
            const ManifestEntry* const entry = manifest_entry(name);
            const std::filesystem::path path = entry == nullptr
                                                   ? std::filesystem::path(name)
                                                   : located(*entry, run.session.scenes().data);
            if (path.empty())
                throw Unavailable(summary(*entry, run.session.scenes().data));
            for (const QuerySet& set : read_queries(path))
                measure_set(run, set, entry == nullptr ? set.name : name + '/' + set.name,
                            entry == nullptr ? path.string() : entry->source);
        });
        if (failure.empty() || !run.task.wants(name, "all"))
            continue;
        Cell all = accuracy_cell("queries", "all", {.name = name});
        run.engine().refuse(all, Cell::Status::skipped, failure);
        run.add(std::move(all));
    }
}

}  // namespace bvhbench
