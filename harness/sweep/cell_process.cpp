// SPDX-License-Identifier: MIT
#include "harness/sweep/cell_process.h"

#include <csignal>
#include <sstream>

#include "harness/number_text.h"
#include "harness/sweep/facts_worker.h"
#include "scenes/worker/worker.h"

namespace bvhbench {
namespace {

constexpr std::size_t most_errors = 1 << 16;  ///< bytes kept of what a process says

Child::Start start_of(const SweepUnit& unit, const SweepFolder& folder, const Options& options,
                      const NodeCosts& costs, const std::string& device)
{
    Child::Start start{.path = "/proc/self/exe",
                       .words = {"bvhbench", "run", folder.experiment_file(unit).string(), "--out",
                                 folder.cell_file(unit).string()},
                       .environment = {ends_with_this_process()},
                       .output = Child::Stream::dropped,
                       .errors = Child::Stream::captured};
    if (costs != NodeCosts{})
        start.words.insert(start.words.end(), {"--sah-inner", number_text(costs.inner),
                                               "--sah-triangle", number_text(costs.triangle)});
    for (std::string& word : common_words(options.common, device))
        start.words.push_back(std::move(word));
    folder.begin(unit);
    return start;
}

/// The last of what it said as the program says what went wrong; drivers may have had words before and after.
std::string sentence_in(const std::string& errors)
{
    constexpr std::string_view mark = "bvhbench: ";
    std::string sentence;
    std::istringstream lines(errors);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(mark))
            sentence = line.substr(mark.size());
    return sentence;
}

}  // namespace

CellProcess::CellProcess(const SweepUnit& unit, const SweepFolder& folder, const Options& options,
                         const NodeCosts& costs, const std::string& device)
    : unit_(unit)
    , cell_file_(folder.cell_file(unit))
    , child_(start_of(unit, folder, options, costs, device))
{
    child_.keep_the_last(most_errors);
}

double CellProcess::seconds() const
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

void CellProcess::give_up(double limit_s)
{
    given_up_ = "its process took longer than " + number_text(limit_s) +
                " s and was ended; --cell-limit gives a cell more";
    child_.send(SIGKILL);
}

CellProcess::Loss CellProcess::end()
{
    const ProcessEnd end = child_.wait();
    if (finished_document(cell_file_))
        return {};
    // What it had measured before stays there, out of the way.
    std::error_code ignored;
    std::filesystem::path partial = cell_file_;
    std::filesystem::rename(cell_file_, partial.replace_extension(".part"), ignored);
    if (!given_up_.empty())
        return {.why = given_up_};
    const std::string sentence = sentence_in(end.output);
    const int signal = end.how == ProcessEnd::How::signalled ? end.code : end.code - 128;
    const bool was_stopped = signal == SIGINT || signal == SIGTERM || signal == SIGHUP;
    if (!was_stopped && end.how == ProcessEnd::How::signalled)
        return {.why = "its process " + spelled(end, 0) + (sentence.empty() ? "" : ": " + sentence),
                .may_be_the_device = true};
    return {.why = !sentence.empty() && !was_stopped
                       ? sentence
                       : "its process " + spelled(end, 0) + " and left no result",
            .is_skipped = end.code == 2,
            .may_be_the_device = end.code == 3,
            .was_stopped = was_stopped};
}

}  // namespace bvhbench
