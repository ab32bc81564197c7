// SPDX-License-Identifier: MIT
#include "harness/record/result_file.h"

#include <algorithm>
#include <functional>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/record/provenance.h"

namespace bvhbench {
namespace {

/// Parses the text if it is a result file of the run `run_id`; else returns nothing.
std::optional<Json> document_of(const std::string& run_id, const std::string& text)
{
    Json json = Json::parse(text, nullptr, false);
    const bool is_own = !run_id.empty() && json.is_object() &&
                        json.value("format", "") == result_format && json.contains("run") &&
                        json["run"].is_object() && json["run"].value("id", "") == run_id &&
                        json.contains("cells");
    return is_own ? std::optional(std::move(json)) : std::nullopt;
}

/// Records the process's memory. Keeps larger values that an earlier process of the same run recorded.
void note_memory(Json& run)
{
    const HostMemoryFacts now = host_memory_facts();
    const Json before = run.value("host_memory", Json::object());
    const auto most = [&](const char* key, std::uint64_t bytes) {
        return std::max(bytes, before.value(key, std::uint64_t{0}));
    };
    if (now.peak > 0)
        run["host_memory"] = {{"given_bytes", now.given},
                              {"predicted_bytes", most("predicted_bytes", now.predicted)},
                              {"peak_bytes", most("peak_bytes", now.peak)}};
}

}  // namespace

OutputRules result_rules(bool force, std::vector<std::string> inputs, std::string own_run)
{
    return {.force = force,
            .inputs = std::move(inputs),
            .may_replace = [own_run = std::move(own_run)](const std::string& text) {
                return document_of(own_run, text).has_value();
            }};
}

ResultFile::ResultFile(Output output, Json run, const std::string& goes_on)
    : output_(std::move(output)), run_(std::move(run))
{
    if (!goes_on.empty() && output_.was_there())
        take_over(goes_on);
    if (output_.is_file())
        at_signal_.emplace([this] { keep(); }, "finished cells are kept");
}

void ResultFile::take_over(const std::string& run_id)
{
    const std::optional<Json> json =
        document_of(run_id, file_text(output_.path(), "the result file"));
    if (!json)
        return;
    run_ = (*json)["run"];
    for (const Json& cell : (*json)["cells"]) {
        cells_.push_back({.text = cell.dump(),
                          .is_measured = cell.value("status", "") == "measured",
                          .differs = cell.value("/check/verdict"_json_pointer, "") == "differs",
                          .reason = cell.value("reason", "")});
        for (const Json& sample : cell.value("samples", Json::array()))
            next_order_ = std::max(next_order_, sample.value("order", 0) + 1);
    }
    has_measured_ = true;  // the earlier file belongs to this run
    goes_on_ = true;
}

bool ResultFile::pass(std::size_t count)
{
    const std::lock_guard lock(mutex_);
    if (goes_on_ && cells_.size() >= passed_ + count) {
        passed_ += count;
        return true;
    }
    if (goes_on_)
        cells_.resize(passed_);
    goes_on_ = false;
    return false;
}

void ResultFile::keep()
{
    using namespace std::chrono_literals;
    const std::unique_lock lock(mutex_, 1s);
    if (!lock)
        throw Unavailable(output_.path().string() + " takes too long to write");
    if (!is_written_ && output_.is_file())
        write();
}

ResultFile::~ResultFile()
{
    at_signal_.reset();
    try {
        keep();
    } catch (const std::exception&) {  // destructors must not throw
    }
}

void ResultFile::add(const Cell& cell)
{
    const std::lock_guard lock(mutex_);
    has_measured_ = has_measured_ || cell.status == Cell::Status::measured;
    cells_.push_back({.text = cell_text(cell),
                      .is_measured = cell.status == Cell::Status::measured,
                      .differs = cell.check.verdict == Check::Verdict::differs,
                      .reason = cell.reason});
    write_if_due();
}

void ResultFile::add(const StressCell& cell)
{
    const std::lock_guard lock(mutex_);
    has_measured_ = true;
    stress_.push_back(cell_text(cell));
    write_if_due();
}

void ResultFile::write_if_due()
{
    using namespace std::chrono_literals;
    is_written_ = false;
    if (output_.is_file() && std::chrono::steady_clock::now() - written_at_ >= 500ms)
        write();
}

void ResultFile::finish(const EndOfRun& end)
{
    const std::lock_guard lock(mutex_);
    run_["compile_ns"] = end.compile_ns;
    if (!end.turns_with.empty())
        run_["turns_with"] = end.turns_with;
    if (end.other_processes)
        put_other_processes(run_["conditions"], *end.other_processes);
    run_["finished_at"] = utc_now();
    write();
}

std::string ResultFile::text() const
{
    const auto lines = [](const auto& cells, const auto& text_of) {
        std::string text;
        for (const auto& cell : cells)
            text += (text.empty() ? "\n" : ",\n") + text_of(cell);
        return text;
    };
    // One cell per line, so that files can be compared by diff.
    std::string text = "{\"format\": \"" + result_format + "\",\n\"run\": " + one_line(run_);
    text += ",\n\"cells\": [" + lines(cells_, std::mem_fn(&Kept::text)) + "\n]";
    if (!stress_.empty())
        text += ",\n\"stress\": [" + lines(stress_, std::identity()) + "\n]";
    return text + "}\n";
}

int ResultFile::exit_code() const
{
    if (!cells_.empty() && std::ranges::none_of(cells_, &Kept::is_measured))
        throw NothingMeasured("nothing was measured: " + cells_.front().reason +
                              (cells_.size() > 1
                                   ? " (the first of " + std::to_string(cells_.size()) + " cells)"
                                   : ""));
    const auto is_wrong = [](const Kept& cell) { return cell.is_measured && cell.differs; };
    return std::ranges::any_of(cells_, is_wrong) ? 1 : 0;
}

std::string ResultFile::written() const
{
    return (is_worth_writing() ? "written: " : "nothing was measured, so it stays as it was: ") +
           output_.path().string() + '\n';
}

/// Cells that only record failures are written, unless they would replace an existing file.
bool ResultFile::is_worth_writing() const
{
    return has_measured_ || (!cells_.empty() && !output_.was_there());
}

void ResultFile::write()
{
    note_memory(run_);
    if (!output_.is_nowhere() && is_worth_writing())
        output_.replace(text());
    written_at_ = std::chrono::steady_clock::now();
    is_written_ = true;
}

}  // namespace bvhbench
