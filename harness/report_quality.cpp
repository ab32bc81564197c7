// SPDX-License-Identifier: MIT
#include "harness/report_quality.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "harness/paper_table.h"
#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

bool is_radix(const std::string& builder)
{
    return builder.starts_with("apetrei") || builder.starts_with("karras") ||
           builder.starts_with("lbvh") || builder.starts_with("radix");
}

std::string number(double value) { return value > 0 ? fixed(value, 2) : ""; }

/// Both kinds of tree on each scene in each order, in the order of the cells. An order without a radix tree of
/// its own is paired with the scene's first.
std::vector<CostPair> cost_pairs(const Document& document)
{
    std::vector<CostPair> pairs;
    std::map<std::pair<std::string, std::string>, std::size_t> places;
    for (const Cell& cell : document.cells) {
        const auto [place, is_new] =
            places.try_emplace({cell.scene.name, cell.builder.order}, pairs.size());
        if (is_new)
            pairs.emplace_back();
        CostPair& pair = pairs[place->second];
        const Cell*& mine = is_radix(cell.builder.name) ? pair.radix : pair.oibvh;
        if (sah_cost(mine) <= 0)  // of several builders of one tree, the first that has it
            mine = &cell;
    }
    std::map<std::string, const Cell*> first_radix;
    for (CostPair& pair : pairs) {
        if (pair.radix != nullptr)
            first_radix.try_emplace(pair.radix->scene.name, pair.radix);
        else if (const auto found = first_radix.find(pair.oibvh->scene.name);
                 found != first_radix.end())
            pair.radix = found->second;
    }
    return pairs;
}

/// The cell that says the pair's order and scene.
const Cell& either(const CostPair& pair) { return pair.oibvh ? *pair.oibvh : *pair.radix; }

/// Why a pair has no ratio: what a cell of it says.
std::string why(const CostPair& pair)
{
    if (pair.radix == nullptr)
        return "no radix tree";
    if (pair.oibvh == nullptr)
        return "no Oi-BVH";
    const Cell& cell = sah_cost(pair.radix) > 0 ? *pair.oibvh : *pair.radix;
    return verdict_text(cell) + (cell.reason.empty() ? "" : ": " + cell.reason);
}

}  // namespace

double sah_cost(const Cell* cell)
{
    if (cell == nullptr || cell->status != Cell::Status::measured ||
        cell->check.verdict == Check::Verdict::differs)
        return 0;
    const auto found = cell->counters.find("sah_cost");
    return found == cell->counters.end() ? 0 : found->second;
}

double CostPair::ratio() const
{
    return sah_cost(radix) > 0 ? sah_cost(oibvh) / sah_cost(radix) : 0;
}

std::string quality_report(const Document& document)
{
    Table table({{"scene", left},
                 {"builder", left},
                 {"SAH"},
                 {"EPO"},
                 {"sibling overlap"},
                 {"levels of leaves", left}});
    const auto value = [](const Cell& cell, const char* counter) {
        const auto found = cell.counters.find(counter);
        return found == cell.counters.end() ? std::string() : fixed(found->second, 2);
    };
    bool has_overlap = false;
    for (const Cell& cell : document.cells) {
        if (cell.leaves_by_depth.empty())
            continue;
        has_overlap = has_overlap || cell.counters.contains("epo");
        table.row({cell.scene.name, variant_text(cell.builder), value(cell, "sah_cost"),
                   value(cell, "epo"), value(cell, "sibling_overlap"),
                   depths_text(cell.leaves_by_depth)});
    }
    return has_overlap ? table.text() : "";
}

std::string table4_report(const Document& document)
{
    const NodeCosts& costs = document.run.costs;
    const PaperCosts paper = costs == NodeCosts{} ? paper_table4() : PaperCosts{};
    Table table({{"mesh", left},
                 {"triangles"},
                 {"order", left},
                 {"radix"},
                 {"paper"},
                 {"Oi-BVH"},
                 {"paper"},
                 {"times"},
                 {"paper"},
                 {"", left}});
    bool has_stand_in = false, has_edition = false;
    for (const CostPair& pair : cost_pairs(document)) {
        const SceneFacts& scene = either(pair).scene;
        const bool is_stand_in = !scene.stand_in_for.empty();
        const std::string mesh = is_stand_in ? scene.stand_in_for : scene.name;
        const std::string model = paper.model_of(mesh);
        has_stand_in = has_stand_in || is_stand_in;
        has_edition = has_edition || model != mesh;
        const double radix = paper.cost(model, "apetrei"), oi = paper.cost(model, "oibvh-multi");
        table.row({mesh + (is_stand_in     ? " *"
                           : model != mesh ? " +"
                                           : ""),
                   scene.triangles > 0 ? grouped(scene.triangles) : "", either(pair).builder.order,
                   number(sah_cost(pair.radix)), number(radix), number(sah_cost(pair.oibvh)),
                   number(oi), number(pair.ratio()), number(radix > 0 ? oi / radix : 0),
                   pair.ratio() > 0 ? "" : why(pair)});
    }
    return table.text() + "surface area cost, " + costs_text(costs) +
           (costs == NodeCosts{} ? "\n" : "; the paper's are for others\n") +
           (has_edition ? "+ another edition of the paper's model, with another triangle count\n"
                        : "") +
           (has_stand_in ? "* a generated stand-in with the mesh's triangle count: the mesh itself "
                           "is not there\n"
                         : "");
}

std::string fig13_report(const Document& document)
{
    Table table({{"mesh", left},
                 {"order", left},
                 {"triangle"},
                 {"diameters"},
                 {"radix"},
                 {"Oi-BVH"},
                 {"times"},
                 {"", left}});
    double first = 0, last = 0;
    for (const CostPair& pair : cost_pairs(document)) {
        const SceneFacts& scene = either(pair).scene;
        const Outlier& outlier = scene.outlier;
        if (outlier.of.empty()) {  // the scene could not be made, so it has no facts
            table.row({scene.name, either(pair).builder.order, "", "", "", "", "", why(pair)});
            continue;
        }
        table.row({outlier.of, either(pair).builder.order, std::to_string(outlier.triangle),
                   fixed(outlier.diameters, 1), number(sah_cost(pair.radix)),
                   number(sah_cost(pair.oibvh)), number(pair.ratio()),
                   pair.ratio() > 0 ? "" : why(pair)});
        if (outlier.diameters == 0 && first == 0)
            first = pair.ratio();
        if (first > 0 && last == 0 && outlier.diameters >= 10)
            last = pair.ratio();
    }
    std::string text = table.text();
    if (first > 0 && last > 0)
        text += std::string("the Oi-BVH's cost relative to the radix tree's ") +
                (last > first ? "grows" : "does not grow") + ", from " + fixed(first, 2) + " to " +
                fixed(last, 2) + " times; the paper has it grow \"much faster\"\n";
    return text;
}

}  // namespace bvhbench
