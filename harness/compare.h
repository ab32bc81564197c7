// SPDX-License-Identifier: MIT
//
// Two result files, cell by cell: what became faster, slower, larger or wrong.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/ratio_interval.h"
#include "harness/record.h"

namespace bvhbench {

struct CompareRules {
    double threshold = 0.05;  ///< the smallest change of time that counts, as a share
    double error =
        0.05;  ///< chance that any cell of two runs of one program is called faster or slower
    bool allow_missing = false;
    bool allow_dirty = false;
    bool other_devices = false;  ///< compare only ratios between the cells of a scene
    bool allow_test_hooks = false;
};

enum class TimeVerdict { same, faster, slower, unsure };

/// "SAME", "FASTER", "SLOWER" or "UNSURE".
std::string_view time_verdict_text(TimeVerdict verdict);

/// How a time of the second file relates to the first's.
struct TimeChange {
    Interval first, second;  ///< medians, in nanoseconds
    Interval ratio;          ///< second over first, over the ratio that the scene has in common
    double p = 1;            ///< of Mann and Whitney
    std::size_t first_count = 0, second_count = 0;
    TimeVerdict verdict = TimeVerdict::unsure;
};

struct ComparedCell {
    const Cell* first = nullptr;
    const Cell* second = nullptr;
    TimeChange time;  ///< of all stages together, which decides
    std::vector<std::pair<std::string, TimeChange>> stages;
    std::vector<std::string> regressions;  ///< of the verdict, the answer and counters
    std::vector<std::string> changes;      ///< of the same, where they are no reason to fail

    bool is_regression() const
    {
        return time.verdict == TimeVerdict::slower || !regressions.empty();
    }
};

/// The cells of a scene together: the device, or what all of them share, became slower or faster.
struct SceneChange {
    const Cell* scene = nullptr;  ///< one of its cells
    std::size_t cells = 0;        ///< with samples enough
    bool is_common = false;  ///< whether these are enough, so that each is judged beside the others
    Interval ratio = {};     ///< median of the cells'; between what the runs wavered by
    double spread = 1;       ///< how far off that a cell's ratio may be by chance, as a ratio
    TimeVerdict verdict = TimeVerdict::unsure;
};

struct Comparison {
    std::vector<SceneChange> scenes;  ///< those with cells enough to tell what they have in common
    std::vector<ComparedCell> cells;  ///< in the first file's order
    std::vector<const Cell*> only_first, only_second;
    double error_of_each = 0;          ///< what a single cell's error must be under
    std::vector<std::string> remarks;  ///< what else the two runs do not have in common
    CompareRules rules;
    bool by_turns = false;  ///< whether the runs sampled by turns: nothing has drifted between them

    bool has_regression() const;
};

/// The fewest samples of each that times are judged by.
constexpr std::size_t fewest_samples = 9;

/// Judge times in the order taken. Faster and slower need all of: at least `fewest_samples` of each; a median that is
/// off by the threshold; an interval of the ratio without 1; and a p of Mann and Whitney below `error`. Same is an
/// interval within the threshold. The rest is unsure. `common` is a ratio that has nothing to do with the cell.
TimeChange time_change(const std::vector<double>& first, const std::vector<double>& second,
                       double threshold, double error, const Interval& common = {1, 1, 1});

/// Throws BadUsage, in a sentence with the files' names, if they cannot be compared so.
void require_comparable(const Document& first, const std::string& first_name,
                        const Document& second, const std::string& second_name,
                        const CompareRules& rules);

/// Both documents must outlive what is returned.
Comparison compare_documents(const Document& first, const Document& second,
                             const CompareRules& rules);

}  // namespace bvhbench
