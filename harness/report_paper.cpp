// SPDX-License-Identifier: MIT
#include "harness/report_paper.h"

#include <map>

#include "harness/paper_table.h"
#include "harness/report.h"
#include "harness/table.h"
#include "oibvh/layout.h"

namespace bvhbench {
namespace {

using enum Table::Align;

double counter(const Cell& cell, const char* key)
{
    const auto found = cell.counters.find(key);
    return found == cell.counters.end() ? 0 : found->second;
}

/// Median of the hierarchy, 0 if the cell has no time that may be printed.
double hierarchy_ns(const Cell& cell)
{
    if (verdict_text(cell) != "agrees")
        return 0;
    return spread_of(stage_times_ns(cell, "hierarchy")).median;
}

double hierarchy_bytes(const Cell& cell)
{
    if (!cell.samples.empty())
        for (const StageTime& time : cell.samples.front().stages)
            if (time.stage == "hierarchy")
                return static_cast<double>(time.moved_bytes);
    return 0;
}

/// The cells' stages of time, rate and memory traffic; or the word why there is none.
std::vector<std::string> time_columns(const Cell& cell, double copy_rate)
{
    const double median = hierarchy_ns(cell);
    if (median <= 0)
        return {verdict_text(cell), "", "", "", ""};
    const Spread spread = spread_of(stage_times_ns(cell, "hierarchy"));
    const double bytes = hierarchy_bytes(cell);
    return {fixed(median * 1e-6, 4),
            fixed(spread.p10 * 1e-6, 4) + "–" + fixed(spread.p90 * 1e-6, 4),
            fixed(static_cast<double>(cell.scene.triangles) * 1e3 / median, 0), bytes_text(bytes),
            copy_share_text(bytes, median, copy_rate)};
}

}  // namespace

double padding_percent(const Cell& cell)
{
    const double nodes = counter(cell, "nodes_count");
    if (nodes <= 0)
        return 0;
    const auto leaves = static_cast<uint>(cell.scene.triangles);
    if (cell.builder.name == "perfect")
        return 100 * (nodes - oi_node_count(oi_shape(leaves))) / nodes;
    const double least = 2.0 * leaves - 1;
    return 100 * (nodes - least) / least;
}

std::string table1_report(const Document& document)
{
    const PaperTable paper = paper_table1();
    Table table({{"mesh", left},
                 {"triangles"},
                 {"builder", left},
                 {"nodes"},
                 {"padding %"},
                 {"paper"},
                 {"ms"},
                 {"p10–p90"},
                 {"Mtris/s"},
                 {"moved"},
                 {"% of copy"},
                 {"paper ms"}});
    bool has_stand_in = false;
    for (const Cell& cell : document.cells) {
        const bool is_stand_in = !cell.scene.stand_in_for.empty();
        has_stand_in = has_stand_in || is_stand_in;
        const std::string mesh = is_stand_in ? cell.scene.stand_in_for : cell.scene.name;
        const PaperRow* printed = paper.find(mesh, cell.builder.name);
        const double nodes = counter(cell, "nodes_count");
        std::vector<std::string> row = {mesh + (is_stand_in ? " *" : ""),
                                        grouped(cell.scene.triangles),
                                        cell.builder.name,
                                        nodes > 0 ? grouped(static_cast<std::int64_t>(nodes)) : "",
                                        nodes > 0 ? padding_text(padding_percent(cell)) : "",
                                        printed != nullptr ? printed->padding_percent : ""};
        for (std::string& entry : time_columns(cell, document.run.copy_rate_bytes_per_s))
            row.push_back(std::move(entry));
        row.push_back(printed != nullptr ? fixed(printed->hierarchy_ms, 3) : "");
        table.row(std::move(row));
    }
    return table.text() +
           "ms: the stage hierarchy from sorted leaves, median; paper ms: " + paper.device + '\n' +
           (has_stand_in ? "* a generated stand-in with the mesh's triangle count: the mesh itself "
                           "is not there\n"
                         : "");
}

std::optional<std::int64_t> crossing_triangles(const Document& document)
{
    std::map<std::int64_t, std::map<std::string, double>> times;  // by size, ascending
    for (const Cell& cell : document.cells)
        if (const double ns = hierarchy_ns(cell); ns > 0)
            times[cell.scene.triangles][cell.builder.name] = ns;
    std::optional<std::int64_t> crossing;
    bool was_slower = false;
    for (const auto& [triangles, by_builder] : times) {
        const auto single = by_builder.find("oibvh-single");
        const auto multi = by_builder.find("oibvh-multi");
        if (single == by_builder.end() || multi == by_builder.end())
            continue;
        if (multi->second > single->second) {
            crossing.reset();
            was_slower = true;
        } else if (!crossing) {
            crossing = triangles;
        }
    }
    return was_slower ? crossing : std::nullopt;
}

std::string fig8_report(const Document& document)
{
    Table table({{"triangles"},
                 {"builder", left},
                 {"ms"},
                 {"p10–p90"},
                 {"Mtris/s"},
                 {"moved"},
                 {"% of copy"},
                 {"Gnodes/s"}});
    for (const Cell& cell : document.cells) {
        std::vector<std::string> row = {grouped(cell.scene.triangles), cell.builder.name};
        for (std::string& entry : time_columns(cell, document.run.copy_rate_bytes_per_s))
            row.push_back(std::move(entry));
        const double ns = hierarchy_ns(cell);
        row.push_back(ns > 0 ? fixed(counter(cell, "nodes_count") / ns, 2) : "");
        table.row(std::move(row));
    }
    const auto crossing = crossing_triangles(document);
    return table.text() +
           (crossing ? "oibvh-multi is the faster one from " + grouped(*crossing) +
                           " triangles on; in the paper, from about 131,072\n"
                     : "oibvh-single and oibvh-multi do not cross here; in the paper they do at "
                       "about 131,072 triangles\n");
}

}  // namespace bvhbench
