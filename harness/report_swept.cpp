// SPDX-License-Identifier: MIT
#include "harness/report_swept.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/report.h"
#include "harness/table.h"

namespace bvhbench {
namespace {

using enum Table::Align;

/// A cell's numbers, or those of several together. What is not known of one is not known of all.
struct Sum {
    double primitives = 0, pairs = 0, broad_ns = 0, whole_ns = 0, truth = 0, missed = 0;

    Sum& operator+=(const Sum& more)
    {
        primitives += more.primitives;
        pairs += more.pairs;
        broad_ns += more.broad_ns;
        whole_ns += more.whole_ns;
        truth += more.truth;
        missed += more.missed;
        return *this;
    }
};

double counter(const Cell& cell, const char* key)
{
    const auto found = cell.counters.find(key);
    return found == cell.counters.end() ? NAN : found->second;
}

Sum numbers_of(const Cell& cell)
{
    Sum sum{.primitives = static_cast<double>(cell.swept.primitives),
            .pairs = counter(cell, "pairs_count"),
            .broad_ns = NAN,
            .whole_ns = NAN,
            .truth = counter(cell, "ground_truth_pairs"),
            .missed = counter(cell, "ground_truth_missed")};
    if (has_times(cell) && !cell.samples.empty()) {
        sum.broad_ns = spread_of(stage_times_ns(cell, "broad")).median;
        sum.whole_ns = spread_of(whole_times_ns(cell)).median;
    }
    return sum;
}

std::string count_text(double value)
{
    return std::isnan(value) ? "" : grouped(static_cast<std::int64_t>(value));
}

std::string number_text(double value, int digits)
{
    return std::isnan(value) ? "" : fixed(value, digits);
}

void add_row(Table& table, std::vector<std::string> names, const Sum& sum, std::string verdict)
{
    for (const double count : {sum.primitives, sum.pairs})
        names.push_back(count_text(count));
    names.push_back(number_text(sum.broad_ns * 1e-6, 3));
    names.push_back(number_text(sum.whole_ns * 1e-6, 3));
    names.push_back(number_text(sum.pairs / sum.whole_ns * 1e3, 1));
    for (const double count : {sum.truth, sum.missed})
        names.push_back(count_text(count));
    names.push_back(number_text(sum.pairs / sum.truth, 1));
    names.push_back(std::move(verdict));
    table.row(std::move(names));
}

/// A scene that was not there has no steps; on the axis it is named all the same.
bool is_swept(const Cell& cell)
{
    return !cell.swept.pairs.empty() || cell.accuracy.axis == "swept";
}

/// Whether both are of one step by one pipeline.
bool belong_together(const Cell& a, const Cell& b)
{
    ColliderChoice as_b = a.collider;
    as_b.among = b.collider.among;
    return is_swept(a) && is_swept(b) && as_b == b.collider && a.builder == b.builder &&
           a.scene.name == b.scene.name && a.scene.frame == b.scene.frame &&
           a.experiment == b.experiment && a.operation == b.operation;
}

std::string why(const Cell& cell)
{
    const std::string& reason = cell.reason.empty() ? cell.check.detail : cell.reason;
    return verdict_text(cell) + (reason.empty() ? "" : ": " + reason);
}

void add_step(Table& table, const std::vector<const Cell*>& cells)
{
    Sum both;
    for (const Cell* cell : cells) {
        const Sum sum = numbers_of(*cell);
        both += sum;
        add_row(table,
                {cell->scene.name +
                     (cell->scene.stand_in_for.empty() ? "" : " for " + cell->scene.stand_in_for),
                 std::to_string(cell->scene.frame), cell->swept.pairs,
                 swept_method(cell->builder, cell->collider)},
                sum, why(*cell));
    }
    if (cells.size() > 1)
        add_row(table, {"", "", "both", ""}, both, "");
}

}  // namespace

std::string swept_method(const BuilderChoice& builder, const ColliderChoice& collider)
{
    return collider.name + (builder.name == "none" ? "" : " over " + variant_text(builder));
}

std::string swept_report(const Document& document, Operation operation)
{
    Table table({{"scene", left},
                 {"step"},
                 {"pairs of", left},
                 {"pipeline", left},
                 {"boxes"},
                 {"pairs"},
                 {"broad, ms"},
                 {"ms"},
                 {"Mpairs/s"},
                 {"ground truth"},
                 {"missed"},
                 {"inflation"},
                 {"verdict", left}});
    std::vector<const Cell*> left_over;
    for (const Cell& cell : document.cells)
        if (is_swept(cell) && cell.operation == operation)
            left_over.push_back(&cell);
    if (left_over.empty())
        return {};
    while (!left_over.empty()) {
        const Cell& first = *left_over.front();
        const auto rest = std::stable_partition(
            left_over.begin(), left_over.end(),
            [&](const Cell* other) { return belong_together(first, *other); });
        add_step(table, {left_over.begin(), rest});
        left_over.erase(left_over.begin(), rest);
    }
    return table.text();
}

}  // namespace bvhbench
