// SPDX-License-Identifier: MIT
#include <iostream>

#include "harness/commands.h"
#include "harness/compare.h"
#include "harness/report_compare.h"
#include "harness/result_file.h"

namespace bvhbench {

int compare(const CompareCommand& command, const Options&)
{
    const Document first = read_result_file(command.first);
    const Document second = read_result_file(command.second);
    const CompareRules rules{.threshold = command.threshold,
                             .allow_missing = command.allow_missing,
                             .allow_dirty = command.allow_dirty,
                             .other_devices = command.other_devices,
                             .allow_test_hooks = command.allow_test_hooks};
    require_comparable(first, command.first, second, command.second, rules);
    const Comparison comparison = compare_documents(first, second, rules);
    std::cout << comparison_report(comparison, command.all);
    return comparison.has_regression() ? 1 : 0;
}

}  // namespace bvhbench
