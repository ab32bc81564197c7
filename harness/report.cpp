// SPDX-License-Identifier: MIT
#include "harness/report.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/hash.h"
#include "harness/cell_identity.h"
#include "harness/sample_times.h"
#include "harness/stopping.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

std::string rate_text(double bytes, double ns)
{
    return bytes > 0 && ns > 0 ? fixed(bytes / ns, 1) : "";  // bytes a nanosecond are GB/s
}

std::string counters_text(const Cell& cell)
{
    std::string text;
    for (const auto& [key, value] : cell.counters) {
        const bool is_whole = value == std::floor(value);
        text += (text.empty() ? "" : ", ") + key + ' ' +
                (is_whole ? grouped(static_cast<std::int64_t>(value)) : fixed(value, 3));
    }
    return text;
}

/// median, p10, q1, q3, p90
std::vector<std::string> spread_texts(const Spread& spread)
{
    return {duration_text(spread.median), duration_text(spread.p10), duration_text(spread.q1),
            duration_text(spread.q3), duration_text(spread.p90)};
}

/// The median of what a stage's launches, or those of "all", waited in that state; blank before format 1.8.
std::string waited_text(const Cell& cell, const std::string& stage, std::int64_t StageTime::*waited)
{
    std::vector<double> sums;
    for (const Sample* sample : counted_samples(cell.samples)) {
        sums.push_back(0);
        for (const StageTime& time : sample->stages)
            sums.back() +=
                time.stage == stage || stage == "all" ? static_cast<double>(time.*waited) : 0;
    }
    const double median = quantile(std::move(sums), 0.5);
    return median > 0 ? duration_text(median) : "";
}

/// How many samples there are, and why no more.
std::string samples_line(const Cell& cell)
{
    const std::size_t counted = counted_samples(cell.samples).size();
    std::string text = std::to_string(cell.samples.size()) + " samples";
    if (cell.sampling.cold)
        text += ", caches emptied before each";
    const auto drifted = std::count_if(cell.samples.begin(), cell.samples.end(),
                                       [](const Sample& sample) { return sample.drifted; });
    if (drifted > 0)
        text += ", " + std::to_string(drifted) + " of them beside drift of the device" +
                (counted < cell.samples.size() ? " and left out here" : "");
    const std::string noise = fixed(100 * relative_quartile_range(whole_times_ns(cell)), 1) + " %";
    const std::string target = fixed(100 * cell.sampling.until, 1) + " %";
    switch (cell.sampling.stopped) {
        case Stopped::steady:
            return text + "; quartiles " + noise + " apart, within " + target;
        case Stopped::noisy:
            return text + "; quartiles " + noise + " apart and staying so, above " + target;
        case Stopped::most:
            return text + "; no more are allowed, quartiles " + noise + " apart, above " + target;
        case Stopped::budget:
            return text + "; the time is over, quartiles " + noise + " apart, above " + target;
        default:
            return text + "; quartiles " + noise + " apart";
    }
}

std::string stages_table(const Cell& cell, double copy_rate)
{
    Table table({{"stage", left},
                 {"median"},
                 {"p10"},
                 {"q1"},
                 {"q3"},
                 {"p90"},
                 {"launches"},
                 {"bytes"},
                 {"GB/s"},
                 {"% of copy"},
                 {"queued"},
                 {"submitted"}});
    const auto row = [&](const std::string& name, const std::vector<double>& times, int launches,
                         double bytes) {
        const Spread spread = spread_of(times);
        std::vector<std::string> entries = {name};
        for (std::string& text : spread_texts(spread))
            entries.push_back(std::move(text));
        entries.insert(
            entries.end(),
            {launches > 0 ? std::to_string(launches) : "host", bytes > 0 ? bytes_text(bytes) : "",
             rate_text(bytes, spread.median), copy_share_text(bytes, spread.median, copy_rate),
             waited_text(cell, name, &StageTime::queued_ns),
             waited_text(cell, name, &StageTime::submitted_ns)});
        table.row(std::move(entries));
    };
    for (const StageTime& stage : cell.samples.front().stages)
        row(stage.stage, stage_times_ns(cell, stage.stage), stage.launches,
            static_cast<double>(stage.moved_bytes));
    if (cell.samples.front().stages.size() > 1) {
        int launches = 0;
        for (const StageTime& stage : cell.samples.front().stages)
            launches += stage.launches;
        row("all", whole_times_ns(cell), launches, moved_bytes(cell));
    }
    return table.text();
}

std::string verdict_line(const Cell& cell)
{
    std::string text = verdict_text(cell);
    if (!cell.check.against.empty())
        text += cell.check.verdict == Check::Verdict::agrees ? " with " + cell.check.against : "";
    if (cell.check.tree_hash)
        text += ", tree " + hex(*cell.check.tree_hash);
    if (cell.check.pairs_hash)
        text += ", pairs " + hex(*cell.check.pairs_hash);
    if (cell.check.contacts_hash)
        text += ", contacts " + hex(*cell.check.contacts_hash);
    if (!cell.check.detail.empty())
        text += ": " + cell.check.detail;
    if (!cell.reason.empty())
        text += ": " + cell.reason;
    return text;
}

std::vector<std::string> line_of(const Cell& cell, double copy_rate)
{
    std::vector<std::string> line = {
        scene_label(cell.scene) + (cell.scene.stand_in_for.empty() ? "" : " *"),
        cell.scene.triangles > 0 ? grouped(cell.scene.triangles) : "", pipeline_text(cell)};
    if (!has_times(cell)) {
        line.insert(line.end(), {verdict_text(cell), "", "", "", "", "", "", "", "", ""});
        line.push_back(!cell.reason.empty() ? cell.reason : cell.check.detail);
        return line;
    }
    const Spread spread = spread_of(whole_times_ns(cell));
    const double rate =
        spread.median > 0 ? static_cast<double>(cell.scene.triangles) * 1e3 / spread.median : 0;
    for (std::string& text : spread_texts(spread))
        line.push_back(std::move(text));
    line.insert(
        line.end(),
        {std::to_string(counted_samples(cell.samples).size()), rate > 0 ? fixed(rate, 1) : "",
         rate > 0 ? fixed(1e3 / rate, 2) : "", rate_text(moved_bytes(cell), spread.median),
         copy_share_text(moved_bytes(cell), spread.median, copy_rate), verdict_text(cell)});
    return line;
}

}  // namespace

bool has_times(const Cell& cell)
{
    return cell.status == Cell::Status::measured && cell.check.verdict != Check::Verdict::differs &&
           !cell.samples.empty();
}

std::vector<double> stage_times_ns(const Cell& cell, std::string_view stage)
{
    std::vector<double> times;
    for (const Sample* sample : counted_samples(cell.samples))
        for (const StageTime& time : sample->stages)
            if (time.stage == stage)
                times.push_back(static_cast<double>(time.elapsed_ns()));
    return times;
}

std::vector<double> whole_times_ns(const Cell& cell)
{
    std::vector<double> times;
    for (const Sample* sample : counted_samples(cell.samples))
        times.push_back(whole_ns(sample->stages));
    return times;
}

double moved_bytes(const Cell& cell)
{
    double bytes = 0;
    if (!cell.samples.empty())
        for (const StageTime& time : cell.samples.front().stages)
            bytes += static_cast<double>(time.moved_bytes);
    return bytes;
}

std::string copy_share_text(double bytes, double ns, double copy_rate_bytes_per_s)
{
    if (!(bytes > 0 && ns > 0 && copy_rate_bytes_per_s > 0))
        return "";
    return fixed(100 * (bytes / (ns * 1e-9)) / copy_rate_bytes_per_s, 1) + " %";
}

std::string verdict_text(const Cell& cell)
{
    if (cell.status != Cell::Status::measured)
        return cell.status == Cell::Status::skipped ? "skipped" : "failed";
    switch (cell.check.verdict) {
        case Check::Verdict::agrees:
            return "agrees";
        case Check::Verdict::differs:
            return "differs";
        case Check::Verdict::counted:
            return "counted";
        default:
            return "not checked";
    }
}

std::string cell_report(const Cell& cell, const RunFacts& run)
{
    std::string text = pipeline_text(cell) + " on " + scene_label(cell.scene);
    if (cell.scene.triangles > 0)
        text += ", " + grouped(cell.scene.triangles) + " triangles";
    if (!cell.scene.stand_in_for.empty())
        text += ", standing in for " + cell.scene.stand_in_for;
    text += '\n';
    if (has_times(cell))
        text += stages_table(cell, run.copy_rate_bytes_per_s) + samples_line(cell) + '\n';
    if (cell.first.run_ns > 0)
        text += "first run " + duration_text(static_cast<double>(cell.first.run_ns)) +
                " on the host's clock, kernels compiled in " +
                duration_text(static_cast<double>(cell.first.compile_ns)) + '\n';
    if (!cell.counters.empty())
        text += "counters: " + counters_text(cell) + '\n';
    for (const auto& [counter, why] : cell.left_out)
        text += "no " + counter + ": " + why + '\n';
    if (!cell.leaves_by_depth.empty())
        text += "levels of leaves: " + depths_text(cell.leaves_by_depth) + '\n';
    return text + "verdict: " + verdict_line(cell) + '\n';
}

std::string cells_report(const Document& document, Lines lines)
{
    Table table({{"scene", left},
                 {"triangles"},
                 {"builder", left},
                 {"median"},
                 {"p10"},
                 {"q1"},
                 {"q3"},
                 {"p90"},
                 {"n"},
                 {"Mtris/s"},
                 {"ns/tri"},
                 {"GB/s"},
                 {"% of copy"},
                 {"verdict", left}});
    std::size_t agreeing = 0;
    std::size_t shown = 0;
    bool has_stand_in = false;
    for (const Cell& cell : document.cells) {
        const bool agrees = verdict_text(cell) == "agrees";
        agreeing += agrees ? 1 : 0;
        const bool is_wanted = lines == Lines::all ||
                               (lines == Lines::of_builds && cell.operation != Operation::collide);
        if (agrees && !is_wanted)
            continue;
        ++shown;
        has_stand_in = has_stand_in || !cell.scene.stand_in_for.empty();
        table.row(line_of(cell, copy_rate_of(document, cell)));
    }
    return (shown > 0 ? table.text() : "") +
           (has_stand_in ? "* a stand-in: the scene itself is not there\n" : "") +
           grouped(static_cast<std::int64_t>(document.cells.size())) + " cells, " +
           grouped(static_cast<std::int64_t>(agreeing)) + " agree\n";
}

std::string frames_report(const Document& document)
{
    Table table({{"scene", left},
                 {"frame"},
                 {"what", left},
                 {"median"},
                 {"p10"},
                 {"q1"},
                 {"q3"},
                 {"p90"},
                 {"n"},
                 {"pairs"},
                 {"contacts"},
                 {"verdict", left}});
    for (const Cell& cell : document.cells) {
        const auto count = [&](const char* counter) {
            const auto at = cell.counters.find(counter);
            return at == cell.counters.end() ? std::string()
                                             : grouped(static_cast<std::int64_t>(at->second));
        };
        std::vector<std::string> row = {scene_label(cell.scene), std::to_string(cell.scene.frame),
                                        pipeline_text(cell)};
        if (has_times(cell)) {
            for (std::string& text : spread_texts(spread_of(whole_times_ns(cell))))
                row.push_back(std::move(text));
            row.push_back(std::to_string(counted_samples(cell.samples).size()));
        } else {
            row.insert(row.end(), {"", "", "", "", "", ""});
        }
        row.insert(row.end(), {count("pairs_count"), count("contacts_count"), verdict_line(cell)});
        table.row(row);
    }
    return table.text();
}

std::string depths_text(const std::vector<std::int64_t>& leaves_by_depth)
{
    const auto begin = leaves_by_depth.begin(), end = leaves_by_depth.end();
    const auto first = std::find_if(begin, end, [](std::int64_t leaves) { return leaves > 0; });
    if (first == end)
        return {};
    if (first + 1 == end)
        return std::to_string(first - begin);
    const std::int64_t all = std::accumulate(begin, end, std::int64_t{0});
    std::int64_t met = 0;
    const auto middle =
        std::find_if(first, end, [&](std::int64_t leaves) { return 2 * (met += leaves) >= all; });
    return std::to_string(first - begin) + "–" + std::to_string(leaves_by_depth.size() - 1) +
           ", half by " + std::to_string(middle - begin);
}

}  // namespace bvhbench
