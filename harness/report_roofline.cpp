// SPDX-License-Identifier: MIT
#include "harness/report_roofline.h"

#include <algorithm>

#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

/// A frame's tree is built as in the cells that build; so of frames over trees only the query is looked at.
bool is_shown(const Cell& cell, const StageTime& stage)
{
    constexpr std::string_view of_queries[] = {"ropes", "broad", "narrow"};
    return cell.operation != Operation::collide || cell.builder.name == "none" ||
           std::find(std::begin(of_queries), std::end(of_queries), stage.stage) !=
               std::end(of_queries);
}

}  // namespace

std::vector<Floor> floors_of(const Document& document)
{
    const RunFacts& run = document.run;
    std::vector<Floor> floors;
    if (!(run.copy_rate_bytes_per_s > 0))
        return floors;
    for (const Cell& cell : document.cells) {
        if (!has_times(cell))
            continue;
        for (const StageTime& stage : cell.samples.front().stages) {
            if (stage.launches == 0 || stage.moved_bytes == 0 || !is_shown(cell, stage))
                continue;
            const auto bytes = static_cast<double>(stage.moved_bytes);
            floors.push_back(
                {cell.scene.name, cell.scene.triangles, pipeline_text(cell), stage.stage,
                 stage.launches, bytes,
                 1e9 * bytes / run.copy_rate_bytes_per_s + stage.launches * run.launch_cost_ns,
                 spread_of(stage_times_ns(cell, stage.stage)).median});
        }
    }
    return floors;
}

std::string roofline_report(const Document& document)
{
    using enum Table::Align;
    if (std::none_of(document.cells.begin(), document.cells.end(),
                     [](const Cell& cell) { return cell.experiment == "roofline"; }))
        return {};
    Table table({{"scene", left},
                 {"of", left},
                 {"stage", left},
                 {"launches"},
                 {"bytes"},
                 {"a triangle"},
                 {"floor"},
                 {"reached"},
                 {"ratio"}});
    for (const Floor& floor : floors_of(document))
        table.row(
            {floor.scene, floor.of, floor.stage, std::to_string(floor.launches),
             bytes_text(floor.bytes),
             fixed(floor.bytes / static_cast<double>(std::max<std::int64_t>(1, floor.triangles)),
                   1),
             duration_text(floor.floor_ns), duration_text(floor.reached_ns),
             fixed(floor.reached_ns / floor.floor_ns, 2)});
    return "floor: bytes at the copy rate, and launches at the launch cost\n" + table.text();
}

}  // namespace bvhbench
