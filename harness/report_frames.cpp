// SPDX-License-Identifier: MIT
#include "harness/report_frames.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/paper_table.h"
#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

/// The frames of one scene by one pipeline.
struct Frames {
    const Cell* first = nullptr;
    std::vector<const Cell*> cells;

    bool takes(const Cell& cell) const
    {
        return first->scene.name == cell.scene.name && first->builder == cell.builder &&
               first->collider == cell.collider && first->experiment == cell.experiment;
    }

    /// The mean of a counter; nothing if a frame does not have it.
    std::string mean_text(const char* counter, double scale, int digits) const
    {
        double sum = 0;
        for (const Cell* cell : cells) {
            const auto found = cell->counters.find(counter);
            if (found == cell->counters.end())
                return {};
            sum += found->second;
        }
        const double mean = sum / static_cast<double>(cells.size()) * scale;
        return digits > 0 ? fixed(mean, digits) : grouped(static_cast<std::int64_t>(mean + 0.5));
    }

    /// How the frames ended: one word for all, or the first that is not "agrees".
    std::string verdict() const
    {
        for (const Cell* cell : cells)
            if (const std::string word = verdict_text(*cell); word != "agrees")
                return word + (cell->reason.empty() ? "" : ": " + cell->reason);
        return "agrees";
    }
};

std::vector<Frames> frames_of(const Document& document)
{
    std::vector<Frames> all;
    for (const Cell& cell : document.cells) {
        if (cell.operation != Operation::collide || !cell.swept.pairs.empty())
            continue;
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const Frames& one) { return one.takes(cell); });
        Frames& frames = found != all.end() ? *found : all.emplace_back(Frames{&cell, {}});
        frames.cells.push_back(&cell);
    }
    return all;
}

/// Mean and deviation over frames of their medians, and the mean of the stage `broad`, in ms; blank unless every frame
/// was right.
std::vector<std::string> time_columns(const Frames& frames)
{
    std::vector<double> medians;
    double broad = 0;
    const auto share = 1e-6 / static_cast<double>(frames.cells.size());
    for (const Cell* cell : frames.cells) {
        if (verdict_text(*cell) != "agrees" || cell->samples.empty())
            return {"", "", ""};
        medians.push_back(spread_of(whole_times_ns(*cell)).median * 1e-6);
        if (const auto times = stage_times_ns(*cell, "broad"); !times.empty())
            broad += spread_of(times).median * share;
    }
    double mean = 0, square = 0;
    for (const double ms : medians)
        mean += ms / static_cast<double>(medians.size());
    for (const double ms : medians)
        square += (ms - mean) * (ms - mean) / static_cast<double>(medians.size());
    return {fixed(mean, 3), fixed(std::sqrt(square), 3), fixed(broad, 3)};
}

void add_paper_rows(Table& table, const Cell& cell, std::string_view name)
{
    const std::string& scene =
        cell.scene.stand_in_for.empty() ? cell.scene.name : cell.scene.stand_in_for;
    for (const PaperFrame& row : paper_frames(name))
        if (row.scene == scene)
            table.row({"", "paper: " + row.method, std::to_string(row.frames),
                       fixed(row.frame_ms, 3), row.stdev_ms > 0 ? fixed(row.stdev_ms, 3) : "", "",
                       fixed(row.memory_mb, 1), "", "", "", "printed"});
}

}  // namespace

std::string frames_table(const Document& document, std::string_view name)
{
    const std::vector<Frames> all = frames_of(document);
    if (all.empty())
        return {};
    Table table({{"scene", left},
                 {"pipeline", left},
                 {"frames"},
                 {"ms"},
                 {"±"},
                 {"broad"},
                 {"MB"},
                 {"pairs"},
                 {"contacts"},
                 {"peak BVTT"},
                 {"verdict", left}});
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Frames& frames = all[k];
        const Cell& first = *frames.first;
        std::vector<std::string> row = {
            first.scene.name +
                (first.scene.stand_in_for.empty() ? "" : " for " + first.scene.stand_in_for),
            pipeline_text(first), std::to_string(frames.cells.size())};
        for (std::string& text : time_columns(frames))
            row.push_back(std::move(text));
        row.push_back(frames.mean_text("memory_bytes", 1e-6, 1));
        for (const char* counter : {"pairs_count", "contacts_count", "bvtt_peak_count"})
            row.push_back(frames.mean_text(counter, 1, 0));
        row.push_back(frames.verdict());
        table.row(row);
        if (!name.empty() &&
            (k + 1 == all.size() || all[k + 1].first->scene.name != first.scene.name))
            add_paper_rows(table, first, name);
    }
    return table.text();
}

}  // namespace bvhbench
