// SPDX-License-Identifier: MIT
#include "harness/record/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// Whether `path` still names the open file: a process that ends may have removed it since it was opened.
bool names(const std::filesystem::path& path, int file)
{
    struct stat opened = {}, named = {};
    return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

FileLock::FileLock(std::filesystem::path path, Kind kind, const std::string& subject,
                   std::chrono::milliseconds patience)
    : path_(std::move(path))
{
    const int wanted = (kind == Kind::exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB;
    const auto until = std::chrono::steady_clock::now() + patience;
    for (;;) {
        file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (file_ < 0)
            throw Unavailable(subject + " cannot be written: " + std::strerror(errno));
        const bool is_locked = flock(file_, wanted) == 0;
        const bool has_locks = is_locked || errno == EWOULDBLOCK || errno == EINTR;
        if (!has_locks || (is_locked && names(path_, file_)))
            return;
        close(file_);
        if (is_locked)
            continue;
        if (std::chrono::steady_clock::now() >= until)
            throw Unavailable(subject + " is being written by another process");
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

FileLock::~FileLock()
{
    if (is_removed_)
        unlink(path_.c_str());
    close(file_);
}

}  // namespace bvhbench
