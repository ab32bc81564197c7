// SPDX-License-Identifier: MIT
#include "harness/record/output.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>
#include <utility>

#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/base/failure.h"
#include "harness/base/json_keys.h"
#include "process/worker.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr int most_links = 40;  ///< the limit of Linux
constexpr auto patience = 1s;   ///< a killed process may hold its lock for a moment

fs::path folder_of(const fs::path& path)
{
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Resolves all links. The resulting file need not exist.
fs::path without_links(fs::path path)
{
    std::error_code error;
    for (int link = 0; fs::is_symlink(path, error); ++link) {
        if (link == most_links)
            cannot_write(path, "too many links");
        path = folder_of(path) / fs::read_symlink(path, error);
    }
    return path;
}

/// Returns standard output or standard error if it is the file described by `about`, else -1. Two descriptors of one file would
/// overwrite each other's text.
int standard_stream(const struct stat& about)
{
    for (const int file : {STDOUT_FILENO, STDERR_FILENO}) {
        struct stat opened = {};
        if (fstat(file, &opened) == 0 && opened.st_dev == about.st_dev &&
            opened.st_ino == about.st_ino)
            return file;
    }
    return -1;
}

/// True if the existing `file` is `input` or lies in that folder.
bool is_input(const fs::path& file, const fs::path& input)
{
    std::error_code error;
    if (fs::equivalent(file, input, error))
        return true;
    if (!fs::is_directory(input, error))
        return false;
    const fs::path inside = fs::canonical(file, error);
    const fs::path folder = fs::canonical(input, error);
    return std::mismatch(folder.begin(), folder.end(), inside.begin(), inside.end()).first ==
           folder.end();
}

/// Returns "is a result of 3 cells", or "is there already" for other files.
std::string contents_of(const std::string& text)
{
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("format") || !json.contains("cells"))
        return "is there already";
    const std::size_t cells = json["cells"].size() + json.value("stress", json.array()).size();
    return "is a result of " + std::to_string(cells) + (cells == 1 ? " cell" : " cells");
}

/// True if `path` still names the open file: another process may have removed the file since it was opened.
bool names(const std::filesystem::path& path, int file)
{
    struct stat opened = {}, named = {};
    return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// A locked file that marks an output as being written. The destructor removes it. The system releases the lock however the
/// process ends. On file systems without locks there is no protection.
class FileLock {
public:
    /// Waits up to `patience` for a process that holds the lock. Throws Unavailable, naming `subject`, if it keeps the lock or if
    /// the file cannot be created.
    FileLock(fs::path path, const std::string& subject) : path_(std::move(path))
    {
        const auto until = std::chrono::steady_clock::now() + patience;
        for (;;) {
            file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
            if (file_ < 0)
                cannot_write(subject);
            const bool is_locked = flock(file_, LOCK_EX | LOCK_NB) == 0;
            const bool has_locks = is_locked || errno == EWOULDBLOCK || errno == EINTR;
            if (!has_locks || (is_locked && names(path_, file_)))
                return;
            close(file_);
            if (!is_locked && std::chrono::steady_clock::now() >= until)
                throw Unavailable(subject + " is being written by another process");
            if (!is_locked)
                std::this_thread::sleep_for(50ms);
        }
    }
    ~FileLock()
    {
        unlink(path_.c_str());
        close(file_);
    }
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

private:
    fs::path path_;
    int file_ = -1;
};

}  // namespace

Output::Output(const fs::path& path, const std::string& option, const OutputRules& rules)
    : path_(path)
{
    if (path.empty())
        return;
    struct stat about = {};
    const bool is_there = stat(path.c_str(), &about) == 0;
    if (is_there && S_ISDIR(about.st_mode))
        throw BadUsage(option + ": " + path.string() + " is a folder; name a file in it");
    if (path.extension() == ".xz")
        throw BadUsage(option + ": " + path.string() +
                       " is not written packed; write it without .xz and pack it with xz");
    is_file_ = !is_there || (S_ISREG(about.st_mode) && standard_stream(about) < 0);
    if (!is_file_)
        return;
    target_ = without_links(path);
    if (!fs::is_directory(folder_of(target_)))
        cannot_write(path, "there is no folder " + folder_of(target_).string());
    if ((is_there && access(target_.c_str(), W_OK) != 0) ||
        access(folder_of(target_).c_str(), W_OK | X_OK) != 0)
        cannot_write(path);
    const fs::path lock = folder_of(target_) / ("." + target_.filename().string() + ".lock");
    lock_ = std::make_shared<const FileLock>(lock, path.string());
    // Checked after locking: the previous holder of the lock may have written the file.
    was_there_ = stat(target_.c_str(), &about) == 0 && about.st_size > 0;
    if (!was_there_)
        return;
    for (const std::string& input : rules.inputs)
        if (is_input(target_, input))
            throw BadUsage(option + ": " + path_.string() +
                           " is read by this command; it is not replaced, choose another file");
    if (rules.force)
        return;
    const std::string text = file_text(target_, "the earlier file");
    if (!rules.may_replace || !rules.may_replace(text))
        throw BadUsage(option + ": " + path_.string() + ' ' + contents_of(text) +
                       "; --force replaces it, or choose another file");
}

void Output::replace(std::string_view text) const
{
    Writer writer(*this);
    writer.append(text);
    writer.finish();
}

Output::Writer::Writer(const Output& output) : output_(output)
{
    struct stat about = {};
    const bool is_there = stat(output.path_.c_str(), &about) == 0;
    if (!output.is_file_) {
        std::cout.flush();
        const int stream = is_there ? standard_stream(about) : -1;
        file_ = stream >= 0 ? fcntl(stream, F_DUPFD_CLOEXEC, 0)
                            : open(output.path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    } else {
        temporary_ = output.target_;
        std::random_device random;
        temporary_ += ".tmp" + hex(std::uint64_t{random()} << 32 | random());
        file_ =
            open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    }
    if (file_ < 0)
        cannot_write(output.path_);
    if (output.is_file_ && is_there) {
        // Only root may change the owner. For other users this fails, and they own the new file.
        [[maybe_unused]] const int given = fchown(file_, about.st_uid, about.st_gid);
        fchmod(file_, about.st_mode & 07777);
    }
}

Output::Writer::~Writer()
{
    if (file_ < 0)
        return;
    close(file_);
    if (!temporary_.empty())
        unlink(temporary_.c_str());
}

void Output::Writer::append(std::string_view text)
{
    if (!write_all(file_, text))
        cannot_write(output_.path_);
}

void Output::Writer::finish()
{
    if (!temporary_.empty()) {
        if (fsync(file_) != 0 || std::rename(temporary_.c_str(), output_.target_.c_str()) != 0)
            cannot_write(output_.path_);
        if (const int folder =
                open(folder_of(output_.target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
            folder >= 0) {
            // Not all file systems can sync a folder; the file is renamed in any case.
            fsync(folder);
            close(folder);
        }
        temporary_.clear();
    }
    if (close(std::exchange(file_, -1)) != 0)
        cannot_write(output_.path_);
}

void check_pictures(const fs::path& folder, const std::string& option, OutputRules rules)
{
    rules.may_replace = [](const std::string& text) {
        return text.starts_with("\x89PNG\r\n") || text.find("<svg") != text.npos;
    };
    std::error_code error;
    // Folders are no input here: no pictures are read from them.
    std::erase_if(rules.inputs, [&](const auto& input) { return fs::is_directory(input, error); });
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (const fs::path end = entry.path().extension(); end == ".png" || end == ".svg")
            Output(entry.path(), option, rules);
}

}  // namespace bvhbench
