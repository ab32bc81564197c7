// SPDX-License-Identifier: MIT
#include "harness/record/result_text.h"

#include <algorithm>

#include "harness/record/earlier_runs.h"
#include "harness/record/record.h"

namespace bvhbench {

CellText text_of(Json cell, const std::string& run)
{
    cell.erase("run");
    return {.text = cell.dump(),
            .run = run,
            .verdict = cell.value("/check/verdict"_json_pointer, ""),
            .reason = cell.value("reason", ""),
            .is_measured = cell.value("status", "") == "measured"};
}

std::string with_key(std::string text, const char* key, const std::string& value)
{
    text.pop_back();
    return text + ",\"" + key + "\":\"" + value + "\"}";
}

std::string result_text(const Json& run, std::span<const Json> runs,
                        std::span<const CellText> cells, const std::vector<std::string>& stress)
{
    const std::string own = run.value("id", "");
    const bool has_others =
        std::ranges::any_of(cells, [&](const CellText& cell) { return cell.run != own; });
    std::vector<std::string> lines, sources;
    for (const CellText& cell : cells)
        lines.push_back(has_others ? with_key(cell.text, "run", cell.run) : cell.text);
    for (const Json& each : runs)
        if (std::ranges::count(cells, each.value("id", ""), &CellText::run) > 0)
            sources.push_back(one_line(source_of(each)));
    std::string text = "{\"format\": \"" + result_format + "\",\n\"run\": " + one_line(run);
    const auto put = [&](const char* name, const std::vector<std::string>& list) {
        text += std::string(",\n\"") + name + "\": [";
        for (const std::string& line : list)
            text += (text.back() == '[' ? "\n" : ",\n") + line;
        text += "\n]";
    };
    if (has_others)
        put("merged_from", sources);
    put("cells", lines);
    if (!stress.empty())
        put("stress", stress);
    return text + "}\n";
}

}  // namespace bvhbench
