// SPDX-License-Identifier: MIT
#include "harness/sweep/units.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <numeric>

#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/report.h"
#include "harness/sweep/experiment.h"
#include "harness/sweep/time_left.h"

namespace bvhbench {
namespace {

SweepUnit unit_of(const Sweep& sweep, std::vector<SweepCell> cells, const std::string& settings)
{
    SweepUnit unit;
    unit.experiment = experiment_of(sweep, cells);
    Hash hash;
    for (const std::string& part : {unit.experiment.dump(), settings})
        hash.bytes(part.c_str(), part.size() + 1);
    unit.what = hash.get();
    unit.triangles = cells.front().triangles;
    unit.label = cells.front().scene_name() + ", ";
    unit.label += cells.size() > 1 ? std::to_string(cells.size()) + " cells"
                                   : pipeline_text(record_of(sweep, cells.front()));
    unit.cells = std::move(cells);
    return unit;
}

}  // namespace

Cell record_of(const Sweep& sweep, const SweepCell& cell)
{
    Cell record;
    record.experiment = sweep.name;
    record.scene.name = cell.scene_name();
    record.builder = cell.builder;
    record.collider = cell.collider;
    record.operation = cell.collides() ? Operation::collide : Operation::build;
    return record;
}

std::vector<SweepUnit> units_of(const Sweep& sweep, bool together, const std::string& settings)
{
    std::vector<std::vector<SweepCell>> groups;
    std::map<std::string, std::size_t> group_of;  // a scene's
    for (const SweepCell& cell : sweep.cells) {
        if (!cell.why_not.empty())
            continue;
        const std::string scene = cell.scene.dump();
        if (const auto found = group_of.find(scene); together && found != group_of.end()) {
            groups[found->second].push_back(cell);
            continue;
        }
        group_of[scene] = groups.size();
        groups.push_back({cell});
    }
    std::vector<SweepUnit> units;
    for (std::vector<SweepCell>& cells : groups)
        units.push_back(unit_of(sweep, std::move(cells), settings));
    return units;
}

Shard shard_called(const std::string& text)
{
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, shard.number);
    auto of = number;
    if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/')
        of = std::from_chars(number.ptr + 1, end, shard.of);
    if (of.ec != std::errc() || of.ptr != end || text.find('/') == text.npos || shard.number < 1 ||
        shard.number > shard.of)
        throw BadUsage("--shard is i/n with i from 1 to n, not '" + text + "'");
    return shard;
}

std::vector<unsigned> shards_of(const std::vector<SweepUnit>& units, unsigned shards)
{
    const auto weight = [&](std::size_t i) {
        return units[i].triangles * static_cast<std::int64_t>(units[i].cells.size()) +
               static_cast<std::int64_t>(TimeLeft::start_triangles);
    };
    std::vector<std::size_t> heaviest_first(units.size());
    std::iota(heaviest_first.begin(), heaviest_first.end(), std::size_t{0});
    std::stable_sort(heaviest_first.begin(), heaviest_first.end(),
                     [&](std::size_t a, std::size_t b) { return weight(a) > weight(b); });
    std::vector<std::int64_t> load(shards, 0);
    std::vector<unsigned> chosen(units.size());
    for (const std::size_t i : heaviest_first) {
        const auto least = std::min_element(load.begin(), load.end());
        *least += weight(i);
        chosen[i] = static_cast<unsigned>(least - load.begin()) + 1;
    }
    return chosen;
}

}  // namespace bvhbench
