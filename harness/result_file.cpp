// SPDX-License-Identifier: MIT
#include "harness/result_file.h"

#include <algorithm>

#include "geometry/error.h"
#include "harness/provenance.h"

namespace bvhbench {

Document read_result_file(const std::filesystem::path& path)
{
    return read_document(file_text(path, "the result file"), path.string());
}

namespace {

bool is_result_of(const std::string& run_id, const std::string& text)
{
    try {
        return !run_id.empty() && read_document(text, "the result file").run.id == run_id;
    } catch (const Unavailable&) {
        return false;
    }
}

}  // namespace

OutputRules result_rules(bool force, std::vector<std::string> inputs, std::string own_run)
{
    return {.force = force,
            .inputs = std::move(inputs),
            .may_replace = [own_run = std::move(own_run)](const std::string& text) {
                return is_result_of(own_run, text);
            }};
}

ResultFile::ResultFile(Output output, RunFacts run, const std::string& goes_on)
    : output_(std::move(output)), document_{std::move(run), {}}
{
    if (!goes_on.empty() && output_.was_there())
        take_over(goes_on);
    if (output_.is_file())
        at_signal_.emplace([this] { keep(); }, "finished cells are kept");
}

void ResultFile::take_over(const std::string& run_id)
{
    if (!is_result_of(run_id, file_text(output_.path(), "the result file")))
        return;
    document_ = read_result_file(output_.path());
    for (const Cell& cell : document_.cells)
        cell_texts_.push_back(cell_text(cell));
    has_measured_ = true;  // the earlier file is this run's own
    goes_on_ = true;
}

bool ResultFile::pass(std::size_t count)
{
    const std::lock_guard lock(mutex_);
    if (goes_on_ && document_.cells.size() >= passed_ + count) {
        passed_ += count;
        return true;
    }
    if (goes_on_) {
        document_.cells.resize(passed_);
        cell_texts_.resize(passed_);
    }
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

int ResultFile::next_order() const
{
    int next = 0;
    for (const Cell& cell : document_.cells)
        for (const Sample& sample : cell.samples)
            next = std::max(next, sample.order + 1);
    return next;
}

ResultFile::~ResultFile()
{
    at_signal_.reset();
    try {
        keep();
    } catch (const std::exception&) {  // a destructor must not throw
    }
}

void ResultFile::add(Cell cell)
{
    const std::lock_guard lock(mutex_);
    has_measured_ = has_measured_ || cell.status == Cell::Status::measured;
    cell_texts_.push_back(cell_text(cell));
    document_.cells.push_back(std::move(cell));
    write_if_due();
}

void ResultFile::add(StressCell cell)
{
    const std::lock_guard lock(mutex_);
    has_measured_ = true;
    stress_texts_.push_back(cell_text(cell));
    document_.stress.push_back(std::move(cell));
    write_if_due();
}

void ResultFile::write_if_due()
{
    using namespace std::chrono_literals;
    is_written_ = false;
    if (output_.is_file() && std::chrono::steady_clock::now() - written_at_ >= 500ms)
        write();
}

void ResultFile::finish(std::int64_t compile_ns)
{
    const std::lock_guard lock(mutex_);
    document_.run.compile_ns = compile_ns;
    document_.run.finished_at = utc_now();
    write();
}

std::string ResultFile::written() const
{
    return (is_worth_writing() ? "written: " : "nothing was measured, so it stays as it was: ") +
           output_.path().string() + '\n';
}

/// Cells that say why nothing was measured are worth a file, but not one that was there.
bool ResultFile::is_worth_writing() const
{
    return has_measured_ || (!document_.cells.empty() && !output_.was_there());
}

void ResultFile::write()
{
    note_memory(document_.run);
    if (!output_.is_nowhere() && is_worth_writing())
        output_.replace(document_text(run_text(document_.run), cell_texts_, stress_texts_));
    written_at_ = std::chrono::steady_clock::now();
    is_written_ = true;
}

}  // namespace bvhbench
