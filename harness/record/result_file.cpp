// SPDX-License-Identifier: MIT
#include "harness/record/result_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/record/provenance.h"

namespace bvhbench {
namespace {

constexpr const char* journal_end = ".journal";

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

std::string counted(std::size_t cells)
{
    return std::to_string(cells) + (cells == 1 ? " cell" : " cells");
}

void add_texts(std::span<const Json> cells, std::vector<CellText>& texts)
{
    for (const Json& cell : cells)
        texts.push_back(text_of(cell, cell.at("run")));
}

}  // namespace

OutputRules result_rules(bool force, std::vector<std::string> inputs, bool resumes)
{
    return {.force = force,
            .inputs = std::move(inputs),
            .may_replace = [resumes](const std::string&) { return resumes; }};
}

ResultFile::ResultFile(Output output, bool force, const Resuming& resuming,
                       const std::string& resumed_run)
    : output_(std::move(output)), resuming_(resuming)
{
    if (!output_.is_file())
        return;
    const std::filesystem::path path = output_.beside(journal_end);
    if (resuming_.is_asked && output_.was_there())
        earlier_ = runs_in_result(output_.path());
    if (std::filesystem::exists(path)) {
        const bool is_read = resuming_.is_asked || !resumed_run.empty();
        if (!is_read && !force)
            throw BadUsage(path.string() +
                           " has cells of a run that did not end: `run --resume` goes on with "
                           "those of a plan, --force begins anew");
        if (is_read && add_journal(path, earlier_))
            is_written_ = false;
        else
            std::filesystem::remove(path);
    }
    run_ = earlier_.last_run;
    has_begun_ = !resumed_run.empty() && earlier_.last_id() == resumed_run;
    has_measured_ = !earlier_.parts.empty();
    at_signal_.emplace([this] { keep(); }, "finished cells are kept");
}

ResultFile::ResultFile(Output output, bool force, Json run, const std::string& resumed_run)
    : ResultFile(std::move(output), force, Resuming{}, resumed_run)
{
    begin(std::move(run));
    begin_part({});
}

ResultFile::~ResultFile()
{
    at_signal_.reset();
    if (is_left_)
        return;
    try {
        keep();
    } catch (const std::exception&) {  // destructors must not throw
    }
}

void ResultFile::begin(Json run)
{
    const std::lock_guard lock(mutex_);
    if (output_.is_file())
        journal_.open(output_.beside(journal_end));
    if (has_begun_)
        return;
    has_begun_ = true;
    run_ = std::move(run);
    earlier_.runs.push_back(run_);
    journal_.append("{\"run\": " + one_line(run_) + '}');
}

void ResultFile::check_earlier(const std::set<std::string>& keys, const Json& run)
{
    is_left_ = true;
    earlier_.check(output_.path(), keys, run, resuming_.other_commits);
    is_left_ = false;
}

std::optional<double> ResultFile::take_part(const std::string& key)
{
    const std::lock_guard lock(mutex_);
    const auto found = earlier_.parts.find(key);
    if (found == earlier_.parts.end() || !found->second.has_ended)
        return std::nullopt;
    const std::string own = has_begun_ ? run_id() : "";
    const auto is_to_retry = [&](const Json& cell) {
        return cell.value("status", "") == "failed" && cell.value("run", "") != own;
    };
    if (resuming_.retries_failed && std::ranges::any_of(found->second.cells, is_to_retry)) {
        found->second.cells.clear();
        return std::nullopt;
    }
    add_texts(found->second.cells, cells_);
    const double seconds = found->second.seconds;
    earlier_.parts.erase(found);
    return seconds;
}

void ResultFile::begin_part(const std::string& key)
{
    const std::lock_guard lock(mutex_);
    part_ = key;
    part_begin_ = cells_.size();
    const auto found = earlier_.parts.find(key);
    if (found == earlier_.parts.end())
        return;
    there_ = std::move(found->second.cells);
    earlier_.parts.erase(found);
    if (there_.empty())
        journal_.append(part_, "keeps", "0");
}

bool ResultFile::pass(std::size_t count)
{
    const std::lock_guard lock(mutex_);
    if (count > 0 && there_.size() >= count) {
        add_texts(std::span(there_).first(count), cells_);
        there_.erase(there_.begin(), there_.begin() + static_cast<std::ptrdiff_t>(count));
        return true;
    }
    if (!there_.empty())
        journal_.append(part_, "keeps", std::to_string(cells_.size() - part_begin_));
    there_.clear();
    return false;
}

void ResultFile::take_rest()
{
    const std::lock_guard lock(mutex_);
    add_texts(there_, cells_);
    there_.clear();
}

void ResultFile::end_part(double seconds)
{
    const std::lock_guard lock(mutex_);
    journal_.append(part_, "ended", Json(std::round(seconds * 10) / 10).dump());
    part_.clear();
}

int ResultFile::next_order() const
{
    int next = 0;
    for (const auto& [key, part] : earlier_.parts)
        for (const Json& cell : part.cells)
            if (has_begun_ && cell.value("run", "") == run_id())
                for (const Json& sample : cell.value("samples", Json::array()))
                    next = std::max(next, sample.value("order", 0) + 1);
    return next;
}

void ResultFile::keep()
{
    using namespace std::chrono_literals;
    const std::unique_lock lock(mutex_, 1s);
    if (!lock)
        throw Unavailable(output_.path().string() + " takes too long to write");
    if (!is_written_ && output_.is_file())
        write();
    remove_journal();
}

void ResultFile::leave()
{
    const std::lock_guard lock(mutex_);
    is_left_ = true;
}

void ResultFile::add(const Cell& cell)
{
    append({.text = cell_text(cell),
            .run = run_.value("id", ""),
            .verdict = std::string(verdict_name(cell.check.verdict)),
            .reason = cell.reason,
            .is_measured = cell.status == Cell::Status::measured});
}

void ResultFile::add(Json cell) { append(text_of(std::move(cell), run_.value("id", ""))); }

void ResultFile::append(const CellText& cell)
{
    const std::lock_guard lock(mutex_);
    has_measured_ = has_measured_ || cell.is_measured;
    cells_.push_back(cell);
    if (!part_.empty())
        cells_.back().text = with_key(cell.text, "part", part_);
    is_written_ = false;
    journal_.append(part_, "cell", cells_.back().text);
}

void ResultFile::add(const StressCell& cell)
{
    const std::lock_guard lock(mutex_);
    has_measured_ = true;
    stress_.push_back(cell_text(cell));
    is_written_ = false;
    journal_.append(part_, "stress", stress_.back());
}

void ResultFile::add_impossible(const Json& cell)
{
    const std::lock_guard lock(mutex_);
    cells_.push_back(text_of(cell, run_.value("id", "")));
}

void ResultFile::finish(const EndOfRun& end)
{
    const std::lock_guard lock(mutex_);
    if (is_written_ && !has_begun_)
        return;  // all of it was there
    if (has_begun_) {
        run_["compile_ns"] = end.compile_ns;
        put_if(run_, "turns_with", end.turns_with);
        if (end.other_processes)
            put_other_processes(run_["conditions"], *end.other_processes);
    }
    run_["finished_at"] = utc_now();
    write();
    remove_journal();
}

/// Returns all cells: those of parts that were not begun come last.
std::vector<CellText> ResultFile::all_cells() const
{
    std::vector<CellText> all = cells_;
    add_texts(there_, all);
    for (const std::string& key : earlier_.order)
        if (const auto part = earlier_.parts.find(key); part != earlier_.parts.end())
            add_texts(part->second.cells, all);
    return all;
}

/// Returns the keys of parts of which cells may be missing.
std::vector<std::string> ResultFile::unfinished_parts() const
{
    std::vector<std::string> keys;
    if (!part_.empty())
        keys.push_back(part_);
    for (const auto& [key, part] : earlier_.parts)
        if (!part.has_ended)
            keys.push_back(key);
    return keys;
}

std::string ResultFile::text() const
{
    std::vector<Json> runs = earlier_.runs;
    for (Json& run : runs)
        if (run.value("id", "") == run_.value("id", ""))
            run = run_;
    return result_text(run_, runs, all_cells(), stress_);
}

std::string ResultFile::outcome_of_part() const
{
    const std::size_t count = cells_.size() - part_begin_;
    if (count != 1)
        return std::to_string(count) + " results";
    const CellText& cell = cells_.back();
    return cell.is_measured ? cell.verdict : "failed: " + cell.reason;
}

int ResultFile::exit_code() const
{
    if (!cells_.empty() && std::ranges::none_of(cells_, &CellText::is_measured))
        throw NothingMeasured(
            "nothing was measured: " + cells_.front().reason +
            (cells_.size() > 1 ? " (the first of " + counted(cells_.size()) + ")" : ""));
    const auto is_wrong = [](const CellText& cell) {
        return cell.is_measured && cell.verdict == verdict_name(Check::Verdict::differs);
    };
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

void ResultFile::remove_journal() const
{
    std::error_code ignored;
    if (output_.is_file())
        std::filesystem::remove(output_.beside(journal_end), ignored);
}

void ResultFile::write()
{
    note_memory(run_);
    run_.erase("unfinished_parts");
    put_if(run_, "unfinished_parts", unfinished_parts());
    if (!output_.is_nowhere() && is_worth_writing())
        output_.replace(text());
    is_written_ = true;
}

}  // namespace bvhbench
