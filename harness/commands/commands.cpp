// SPDX-License-Identifier: MIT
#include <re2/re2.h>

#include <stdexcept>
#include <string>

#include "harness/commands/command.h"

namespace bvhbench {
namespace {

/// Returns the entry of a command that is implemented in plots/commands/NAME.py, where its summary stands.
CommandEntry in_python(const std::string& name, std::string_view group)
{
    const std::string pattern = "command\\.Parser\\(\\s*\"(" + name + ")\", \"([^\"]+)\",";
    re2::StringPiece found, summary;
    const std::string file = "plots/commands/" + name + ".py";
    if (!RE2::PartialMatch(python_command(file).value_or(""), pattern, &found, &summary))
        throw std::logic_error(file + " has no parser with the command's name and summary");
    return {.name = {found.data(), found.size()},
            .group = group,
            .summary = {summary.data(), summary.size()}};
}

}  // namespace

extern const CommandEntry build_command, collide_command, cluster_command, run_command,
    accuracy_command, tune_command, list_command, check_command, stress_command, facts_command,
    scene_command, expand_command, view_command;

std::span<const CommandEntry> commands()
{
    // To add a command, add its line here.
    static const CommandEntry all[] = {
        list_command,
        scene_command,
        build_command,
        collide_command,
        cluster_command,
        run_command,
        in_python("sweep", measuring),
        in_python("scale", measuring),
        in_python("best", measuring),
        in_python("reproduce", measuring),
        accuracy_command,
        tune_command,
        in_python("show", looking),
        in_python("compare", looking),
        in_python("plot", looking),
        in_python("report", looking),
        in_python("export", looking),
        in_python("merge", looking),
        in_python("data", looking),
        check_command,
        in_python("smoke", checking),
        stress_command,
        facts_command,
        expand_command,
        view_command,
    };
    return all;
}

}  // namespace bvhbench
