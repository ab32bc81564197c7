// SPDX-License-Identifier: MIT
#include "harness/record/result_file.h"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <sstream>

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

/// Returns what a file of several runs keeps of each (results/schema, `source`). `run` may be that already.
Json source_of(const Json& run)
{
    if (!run.contains("program"))
        return run;
    Json source;
    const auto keep = [&](const Json& facts, const char* key, const char* name) {
        if (facts.contains(key))
            source[name] = facts[key];
    };
    for (const char* key : {"id", "started_at", "finished_at", "command"})
        keep(run, key, key);
    keep(run["program"], "commit", "commit");
    keep(run["program"], "dirty", "dirty");
    keep(run["host"], "name", "host");
    keep(run["device"], "name", "device");
    keep(run["device"], "driver", "driver");
    for (const char* key : {"copy_rate_bytes_per_s", "launch_cost_ns", "conditions"})
        keep(run, key, key);
    return source;
}

std::string device_of(const Json& source)
{
    return source.value("device", "") + ", driver " + source.value("driver", "");
}

std::string program_of(const Json& source)
{
    return "commit " + source.value("commit", "").substr(0, 10) +
           (source.value("dirty", false) ? " with changes" : "");
}

std::string with_key(std::string text, const char* key, const std::string& value)
{
    text.pop_back();
    return text + ",\"" + key + "\":\"" + value + "\"}";
}

std::string counted(std::size_t cells)
{
    return std::to_string(cells) + (cells == 1 ? " cell" : " cells");
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
    const bool has_journal = std::filesystem::exists(path);
    if (resuming_.is_asked && output_.was_there())
        earlier_ = measured_in(output_.path());
    if (has_journal && (resuming_.is_asked || !resumed_run.empty()))
        add_journal(path, earlier_);
    else if (has_journal && !force)
        throw BadUsage(path.string() +
                       " has cells of a run that did not end: `run --resume` goes on with those of "
                       "a plan, --force begins anew");
    else if (has_journal)
        std::filesystem::remove(path);
    run_ = earlier_.last_run;
    has_begun_ = !resumed_run.empty() && run_.is_object() && run_.value("id", "") == resumed_run;
    is_written_ = !has_journal;
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

void ResultFile::check_earlier(const std::set<std::string>& keys, const Json& run) const
{
    const auto foreign = std::ranges::count_if(
        earlier_.order, [&](const std::string& key) { return !keys.contains(key); });
    const std::string holds = output_.path().string() + " has ";
    const char* const instead = "; choose another --out, or --force begins anew";
    if (foreign > 0)
        throw BadUsage(
            holds + std::to_string(foreign) + " of " + std::to_string(earlier_.order.size()) +
            " parts that are none of this plan, or were measured with other options" + instead);
    const Json own = source_of(run);
    for (const Json& each : earlier_.runs) {
        const Json source = source_of(each);
        if (device_of(source) != device_of(own))
            throw BadUsage(holds + "cells of " + device_of(source) + ", and this is " +
                           device_of(own) + instead);
        if (program_of(source) != program_of(own) && !resuming_.other_commits)
            throw BadUsage(holds + "cells by " + program_of(source) + ", and this program is of " +
                           program_of(own) + ": --continue-other-commit keeps them and goes on" +
                           instead);
    }
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
    take_over(found->second.cells);
    const double seconds = found->second.seconds;
    earlier_.parts.erase(found);
    return seconds;
}

void ResultFile::begin_part(const std::string& key)
{
    const std::lock_guard lock(mutex_);
    part_ = key;
    part_begin_ = cells_.size();
    taken_ = 0;
    const auto found = earlier_.parts.find(key);
    const bool is_known = found != earlier_.parts.end();
    there_ = is_known ? std::move(found->second.cells) : std::vector<Json>();
    if (!is_known)
        return;
    if (there_.empty())
        journal_.append("{\"part\": \"" + part_ + "\", \"keeps\": 0}");
    earlier_.parts.erase(found);
}

bool ResultFile::pass(std::size_t count)
{
    const std::lock_guard lock(mutex_);
    if (count > 0 && there_.size() >= taken_ + count) {
        take_over(std::span(there_).subspan(taken_, count));
        taken_ += count;
        return true;
    }
    if (there_.size() > taken_)
        journal_.append("{\"part\": \"" + part_ + "\", \"keeps\": " + std::to_string(taken_) + '}');
    there_.resize(taken_);
    return false;
}

void ResultFile::end_part(double seconds)
{
    const std::lock_guard lock(mutex_);
    std::ostringstream line;
    line << "{\"part\": \"" << part_ << "\", \"ended\": " << std::fixed << std::setprecision(1)
         << seconds << '}';
    journal_.append(line.str());
}

/// Returns a cell of which nothing more will change.
ResultFile::CellText ResultFile::kept(Json cell, const std::string& run)
{
    cell.erase("run");
    return {.text = cell.dump(),
            .run = run,
            .verdict = cell.value("/check/verdict"_json_pointer, ""),
            .reason = cell.value("reason", ""),
            .is_measured = cell.value("status", "") == "measured"};
}

void ResultFile::take_over(std::span<const Json> cells)
{
    for (const Json& cell : cells)
        cells_.push_back(kept(cell, cell.at("run")));
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

/// Writes a line to the journal, `text` as its `kind`.
void ResultFile::add_line(const char* kind, const std::string& text)
{
    is_written_ = false;
    journal_.append("{\"part\": \"" + part_ + "\", \"" + kind + "\": " + text + '}');
}

void ResultFile::add(const Cell& cell)
{
    const std::lock_guard lock(mutex_);
    has_measured_ = has_measured_ || cell.status == Cell::Status::measured;
    const std::string text = cell_text(cell);
    cells_.push_back({.text = part_.empty() ? text : with_key(text, "part", part_),
                      .run = run_.value("id", ""),
                      .verdict = std::string(verdict_name(cell.check.verdict)),
                      .reason = cell.reason,
                      .is_measured = cell.status == Cell::Status::measured});
    add_line("cell", cells_.back().text);
}

void ResultFile::add(const StressCell& cell)
{
    const std::lock_guard lock(mutex_);
    has_measured_ = true;
    stress_.push_back(cell_text(cell));
    add_line("stress", stress_.back());
}

void ResultFile::add_impossible(const Json& cell)
{
    const std::lock_guard lock(mutex_);
    cells_.push_back(kept(cell, run_.value("id", "")));
}

void ResultFile::finish(const EndOfRun& end)
{
    const std::lock_guard lock(mutex_);
    if (is_written_ && !has_begun_)
        return;  // all of it was there
    if (has_begun_) {
        run_["compile_ns"] = end.compile_ns;
        if (!end.turns_with.empty())
            run_["turns_with"] = end.turns_with;
        if (end.other_processes)
            put_other_processes(run_["conditions"], *end.other_processes);
    }
    run_["finished_at"] = utc_now();
    write();
    remove_journal();
}

/// Returns all cells: those of parts that were not begun come last.
std::vector<ResultFile::CellText> ResultFile::all_cells() const
{
    std::vector<CellText> all = cells_;
    for (std::size_t k = taken_; k < there_.size(); ++k)
        all.push_back(kept(there_[k], there_[k].at("run")));
    for (const std::string& key : earlier_.order)
        if (const auto part = earlier_.parts.find(key); part != earlier_.parts.end())
            for (const Json& cell : part->second.cells)
                all.push_back(kept(cell, cell.at("run")));
    return all;
}

std::string ResultFile::text() const
{
    const std::vector<CellText> cells = all_cells();
    std::vector<std::string> lines, sources;
    const std::string own = run_.value("id", "");
    const bool is_merged =
        std::ranges::any_of(cells, [&](const CellText& cell) { return cell.run != own; });
    for (const CellText& cell : cells)
        lines.push_back(is_merged ? with_key(cell.text, "run", cell.run) : cell.text);
    for (const Json& run : earlier_.runs)
        if (is_merged && std::ranges::count(cells, run.value("id", ""), &CellText::run) > 0)
            sources.push_back(source_of(run.value("id", "") == own ? run_ : run).dump());
    // One cell per line, so that files can be compared by diff.
    std::string text = "{\"format\": \"" + result_format + "\",\n\"run\": " + one_line(run_);
    const auto put = [&](const char* name, const std::vector<std::string>& list) {
        text += std::string(",\n\"") + name + "\": [";
        for (const std::string& line : list)
            text += (text.back() == '[' ? "\n" : ",\n") + line;
        text += "\n]";
    };
    if (is_merged)
        put("merged_from", sources);
    put("cells", lines);
    if (!stress_.empty())
        put("stress", stress_);
    return text + "}\n";
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
    if (!output_.is_nowhere() && is_worth_writing())
        output_.replace(text());
    is_written_ = true;
}

}  // namespace bvhbench
