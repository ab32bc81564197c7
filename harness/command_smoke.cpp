// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iostream>

#include "geometry/error.h"
#include "harness/commands.h"
#include "harness/output.h"
#include "harness/provenance.h"
#include "harness/report.h"
#include "harness/run.h"
#include "harness/smoke.h"
#include "harness/test_hooks.h"

namespace bvhbench {
namespace {

SmokeBaseline read_baseline(const std::filesystem::path& path, const std::string& kind)
{
    if (std::error_code error; !std::filesystem::exists(path, error))
        throw Unavailable("there is no baseline '" + path.string() +
                          "' to hold this run to; smoke --update makes it");
    SmokeBaseline baseline = read_smoke(file_text(path, "the baseline"), path.string());
    if (baseline.device_kind != kind)
        throw BadUsage(path.string() + " is of a device of kind " + baseline.device_kind +
                       ", and this one is of kind " + kind);
    return baseline;
}

/// What is wrong in itself is no baseline.
void require_sound(const Document& document)
{
    for (const Cell& cell : document.cells)
        if (cell.status == Cell::Status::failed || verdict_text(cell) == "differs")
            throw Unavailable("--update: " + cell.builder.name + " on " + cell.scene.name + " is " +
                              verdict_text(cell) + ": no baseline is made of that");
}

/// Whether it is the text of an earlier baseline, which --update replaces.
bool is_smoke(const std::string& text)
{
    try {
        read_smoke(text, "the baseline");
        return true;
    } catch (const Unavailable&) {
        return false;
    }
}

int told(const SmokeResult& result, double tolerance)
{
    for (const std::string& remark : result.remarks)
        std::cout << "changed: " << remark << '\n';
    for (const std::string& regression : result.regressions)
        std::cout << "REGRESSION " << regression << '\n';
    std::cout << result.compared << " cells held to the baseline, " << result.timed << " times to "
              << tolerance << " times the ratio there: "
              << (result.regressions.empty()
                      ? "as before"
                      : std::to_string(result.regressions.size()) + " regressions")
              << '\n';
    return result.regressions.empty() ? 0 : 1;
}

}  // namespace

int smoke(const SmokeCommand& command, const Options& options)
{
    const Experiment experiment = find_experiment("smoke", false);
    const CellFilter filter = cell_filter(command.filter);
    if (command.update && filter)
        throw BadUsage("--update writes the whole baseline, so --filter is not for it");
    if (command.update && !test_hooks().empty())
        throw BadUsage("--update: " + test_hooks().begin()->first +
                       " is set, which changes times for tests");
    CommonOptions common = options.common;
    if (!common.tuning)
        common.tuning = "";  // what is compared must not depend on which device is known
    Session session(common);
    const std::string kind = device_facts(session.device()).kind;
    const std::filesystem::path path =
        command.baseline.empty() ? smoke_path(kind) : std::filesystem::path(command.baseline);
    SmokeBaseline before;
    Output updated;
    if (command.update)
        updated =
            Output(path, "--baseline", {.force = options.common.force, .may_replace = is_smoke});
    else
        before = read_baseline(path, kind);  // better to know now than after a minute
    Run run(session,
            Output(command.out, "--out",
                   result_rules(options.common.force, {path}, session.watchdog().run_id())),
            options.words, {});
    run.experiment(experiment, filter);
    run.finish();
    const Document& document = run.document();
    if (document.cells.empty())
        throw BadUsage("--filter: no cell of smoke matches '" + command.filter + "'");
    std::cout << run_report(document.run) << cells_report(document, Lines::notable);
    const SmokeBaseline now = smoke_baseline(document);
    if (command.update) {
        require_sound(document);
        updated.replace(smoke_text(now));
        std::cout << "written: " << path.string() << '\n';
        return 0;
    }
    const int code =
        told(compare_smoke(before, now, command.tolerance, filter.has_value()), command.tolerance);
    return code != 0 ? code : exit_code_of(document);
}

}  // namespace bvhbench
