// SPDX-License-Identifier: MIT
#include "harness/paper_table.h"

#include <nlohmann/json.hpp>

namespace bvhbench {

const PaperRow* PaperTable::find(std::string_view scene, std::string_view builder) const
{
    for (const PaperRow& row : rows)
        if (row.scene == scene && row.builder == builder)
            return &row;
    return nullptr;
}

double PaperCosts::cost(const std::string& scene, const std::string& builder) const
{
    const auto found = costs.find({scene, builder});
    return found == costs.end() ? 0 : found->second;
}

std::string PaperCosts::model_of(const std::string& scene) const
{
    const auto found = other_editions.find(scene);
    return found == other_editions.end() ? scene : found->second;
}

PaperCosts paper_table4()
{
    const auto json = nlohmann::json::parse(embedded_paper("results/paper/table4.json").value());
    PaperCosts table;
    table.other_editions = json.at("other_editions");
    for (const auto& row : json.at("rows"))
        table.costs[{row.at("scene").get<std::string>(), row.at("builder").get<std::string>()}] =
            row.at("sah_cost").get<double>();
    return table;
}

std::vector<PaperFrame> paper_frames(std::string_view table)
{
    const auto json = nlohmann::json::parse(
        embedded_paper("results/paper/" + std::string(table) + ".json").value());
    std::vector<PaperFrame> frames;
    for (const auto& row : json.at("rows"))
        frames.push_back({row.at("scene").get<std::string>(), row.at("method").get<std::string>(),
                          row.at("frames").get<int>(), row.at("frame_ms").get<double>(),
                          row.value("frame_stdev_ms", 0.0),
                          row.at("memory_megabytes").get<double>()});
    return frames;
}

PaperTable paper_table1()
{
    const auto json = nlohmann::json::parse(embedded_paper("results/paper/table1.json").value());
    PaperTable table{json.at("device").get<std::string>(), {}};
    for (const auto& row : json.at("rows"))
        table.rows.push_back(
            {row.at("scene").get<std::string>(), row.at("builder").get<std::string>(),
             row.at("padding_percent").get<std::string>(), row.at("hierarchy_ms").get<double>()});
    return table;
}

}  // namespace bvhbench
