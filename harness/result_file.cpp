// SPDX-License-Identifier: MIT
#include "harness/result_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "geometry/error.h"
#include "harness/provenance.h"

namespace bvhbench {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path)
{
    throw Unavailable(path.string() + " cannot be written: " + std::strerror(errno));
}

/// A file beside `path` that becomes `path`, or vanishes.
class Temporary {
public:
    explicit Temporary(const std::filesystem::path& path) : path_(path), temporary_(path)
    {
        std::error_code error;
        if (path.has_parent_path())
            std::filesystem::create_directories(path.parent_path(), error);
        temporary_ += ".tmp" + std::to_string(getpid());
        descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
        if (descriptor_ < 0)
            fail(path);
    }
    ~Temporary()
    {
        close(descriptor_);
        if (!is_renamed_)
            unlink(temporary_.c_str());
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    void write_all(const std::string& text) const
    {
        for (std::size_t done = 0; done < text.size();) {
            const ssize_t count = write(descriptor_, text.data() + done, text.size() - done);
            if (count < 0 && errno != EINTR)
                fail(path_);
            done += count > 0 ? static_cast<std::size_t>(count) : 0;
        }
        if (fsync(descriptor_) != 0)
            fail(path_);
    }

    void become_path()
    {
        if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
            fail(path_);
        is_renamed_ = true;
    }

private:
    std::filesystem::path path_, temporary_;
    int descriptor_ = -1;
    bool is_renamed_ = false;
};

}  // namespace

void write_atomically(const std::filesystem::path& path, const std::string& text)
{
    Temporary file(path);
    file.write_all(text);
    file.become_path();
}

std::string file_text(const std::filesystem::path& path, const std::string& what)
{
    std::ifstream file(path, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(file), {});
    if (!file.is_open() || file.bad())
        throw Unavailable(what + " '" + path.string() + "' cannot be read");
    return text;
}

Document read_result_file(const std::filesystem::path& path)
{
    return read_document(file_text(path, "the result file"), path.string());
}

ResultFile::ResultFile(std::filesystem::path path, RunFacts run, const std::string& goes_on)
    : path_(std::move(path)), document_{std::move(run), {}}
{
    if (path_.empty())
        return;
    const Temporary probe(path_);  // better to know now than after an hour
    if (!goes_on.empty())
        take_over(goes_on);
    at_signal_.emplace([this] { keep(); }, "finished cells are kept");
}

void ResultFile::take_over(const std::string& run_id)
{
    std::ifstream file(path_, std::ios::binary);
    if (!file.is_open())
        return;  // no cell had been finished
    Document before =
        read_document(std::string(std::istreambuf_iterator<char>(file), {}), path_.string());
    if (before.run.id != run_id)
        return;
    document_ = std::move(before);
    for (const Cell& cell : document_.cells)
        cell_texts_.push_back(cell_text(cell));
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
        throw Unavailable(path_.string() + " takes too long to write");
    if (!is_written_)
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
    cell_texts_.push_back(cell_text(cell));
    document_.cells.push_back(std::move(cell));
    write_if_due();
}

void ResultFile::add(StressCell cell)
{
    const std::lock_guard lock(mutex_);
    stress_texts_.push_back(cell_text(cell));
    document_.stress.push_back(std::move(cell));
    write_if_due();
}

void ResultFile::write_if_due()
{
    using namespace std::chrono_literals;
    is_written_ = false;
    if (std::chrono::steady_clock::now() - written_at_ >= 500ms)
        write();
}

void ResultFile::finish(std::int64_t compile_ns)
{
    const std::lock_guard lock(mutex_);
    document_.run.compile_ns = compile_ns;
    document_.run.finished_at = utc_now();
    write();
}

void ResultFile::write()
{
    if (!path_.empty())
        write_atomically(path_, document_text(run_text(document_.run), cell_texts_, stress_texts_));
    written_at_ = std::chrono::steady_clock::now();
    is_written_ = true;
}

}  // namespace bvhbench
