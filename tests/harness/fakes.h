// SPDX-License-Identifier: MIT
//
// Invented results with numbers that are easy to recognise.
#pragma once

#include "harness/base/json_keys.h"
#include "harness/record/record.h"
#include "harness/session/sampler.h"
#include "tests/refusal.h"

namespace bvhbench {

inline Json fake_run()
{
    return {{"id", "20251130T081542Z-host-00ff"},
            {"started_at", "2025-11-30T08:15:42Z"},
            {"command", {"bvhbench", "run", "table1"}},
            {"compile_ns", 5000}};
}

inline StageTime fake_stage(std::string stage, std::int64_t span_ns, std::int64_t moved_bytes)
{
    return {std::move(stage), span_ns - 10, span_ns, 0, 2, moved_bytes};
}

/// Reports the listed times in order, then the last one for all later samples: half of each to build, and then all of it to query. Throws if
/// there are none.
struct ListedTimes {
    std::vector<std::int64_t> times = {1000};
    std::size_t next = 0;

    std::vector<StageTime> operator()()
    {
        if (times.empty())
            throw Unavailable("out of device memory");
        const std::int64_t ns = times[std::min(next++, times.size() - 1)];
        return {{"hierarchy", ns / 2, ns / 2, 0, 1, 0, 0}, {"broad", ns, ns, 0, 1, 0, ns / 2}};
    }
};

/// Samples these, each as a cell.
template <class... Timed>
std::vector<CellSamples> sampled(const SamplingPlan& plan, Timed&... timed)
{
    int order = 0;
    return take_samples(std::vector<CellToSample>{{"a cell", std::ref(timed)}...}, plan, order);
}

/// Returns a cell of a builder on a scene of 144,046 triangles, with hierarchy times of 90, 100 and 110 microseconds.
inline Cell fake_cell(std::string builder = "oibvh-multi", std::int64_t hierarchy_ns = 100000)
{
    Cell cell;
    cell.experiment = "table1";
    cell.scene.name = "bunny";
    cell.scene.triangles = 144046;
    cell.scene.vertices = 72027;
    cell.scene.objects = 1;
    cell.scene.source = "bunny.ply";
    cell.scene.content_hash = 0xab54a98ceb1f0au;
    cell.builder.name = std::move(builder);
    cell.warm_up = 1;
    int order = 7;
    for (const std::int64_t offset : {10000, 0, -10000})
        cell.samples.push_back(
            {order++, {fake_stage("hierarchy", hierarchy_ns + offset, 50000000)}});
    cell.counters = {{"nodes_count", 288100}, {"tree_bytes", 6914400}, {"scratch_bytes", 0}};
    cell.check = {Check::Verdict::agrees, "oibvh-reference", "", 0xffu};
    return cell;
}

}  // namespace bvhbench
