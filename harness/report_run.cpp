// SPDX-License-Identifier: MIT
#include <cstdio>
#include <set>

#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20); }

}  // namespace

std::string costs_text(const NodeCosts& costs)
{
    char text[80];
    std::snprintf(text, sizeof text, "an inner node %.10g, a triangle %.10g", costs.inner,
                  costs.triangle);
    return text;
}

std::string run_report(const RunFacts& run)
{
    std::string text = "device: " + run.device.platform + '/' + run.device.name + ", driver " +
                       run.device.driver + '\n';
    text += "program: " + run.version + ", commit " + run.commit +
            (run.dirty ? " with changes" : "") + ", " + run.build_type + '\n';
    for (const std::string& warning : run.conditions.warnings)
        text += "warning: " + warning + '\n';
    for (const auto& [hook, value] : run.test_hooks)
        text += "NO RESULT: made under the test hook " + hook + '=' + value + '\n';
    if (run.memory.peak > 0)
        text += "memory: " + mebibytes(run.memory.peak) + " MiB at most, " +
                mebibytes(run.memory.predicted) + " predicted, " + mebibytes(run.memory.given) +
                " given\n";
    if (run.launch_cost_ns > 0)
        text += "launch cost: " + duration_text(run.launch_cost_ns) + '\n';
    if (!run.tuning.empty()) {
        text += "tuned by " + run.tuning_from + ':';
        for (const auto& [name, value] : run.tuning)
            text += ' ' + name + '=' + std::to_string(value);
        text += '\n';
    }
    if (run.copy_rate_bytes_per_s > 0)
        text += "copy rate: " + fixed(run.copy_rate_bytes_per_s * 1e-9, 1) +
                " GB/s, read plus written\n";
    if (run.costs != NodeCosts{})
        text += "costs in sah_cost and epo: " + costs_text(run.costs) + '\n';
    return text;
}

std::string merged_report(const Document& document)
{
    if (document.merged_from.empty())
        return {};
    std::set<std::string> hosts, devices, commits;
    for (const SourceRun& source : document.merged_from) {
        hosts.insert(source.host);
        devices.insert(source.device + ", driver " + source.driver);
        commits.insert(source.commit.substr(0, 10) + (source.dirty ? " with changes" : ""));
    }
    const auto said = [](const char* what, const std::set<std::string>& all) {
        std::string text;
        for (const std::string& one : all)
            text += (text.empty() ? std::string(what) + ' ' : "; ") + one;
        return text;
    };
    std::string text =
        "merged from " + counted(document.merged_from.size(), "run") + said(" on", hosts);
    if (devices.size() > 1)
        text += "\nof several devices: " + said("", devices);
    if (commits.size() > 1)
        text += "\nof several commits: " + said("", commits);
    return text + '\n';
}

}  // namespace bvhbench
