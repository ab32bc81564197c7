// SPDX-License-Identifier: MIT
#include <iostream>

#include "harness/commands.h"
#include "harness/merge.h"
#include "harness/result_file.h"
#include "harness/table.h"

namespace bvhbench {

int merge(const MergeCommand& command, const Options& options)
{
    const Output output(command.out, "--out", result_rules(options.common.force, command.files));
    std::vector<MergePart> parts;
    for (const std::string& path : command.files)
        parts.push_back({path, file_text(path, "the result file")});
    const Merged merged = merge(
        parts, {.other_devices = command.other_devices, .other_commits = command.other_commits});
    output.replace(merged.text);
    std::cout << counted(merged.cells, "cell") << " of " << counted(merged.runs, "run");
    if (merged.repeated > 0)
        std::cout << "; in more than one file, the same in each: " << merged.repeated;
    std::cout << "\nwritten: " << command.out << '\n';
    return merged.differs ? 1 : 0;
}

}  // namespace bvhbench
