// SPDX-License-Identifier: MIT
#include "harness/sweep/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "geometry/error.h"

namespace bvhbench {
namespace {

using namespace std::chrono_literals;

/// A shard looks at the plan for no longer than this, and so does the system until a process that was killed is gone.
constexpr auto patience = 5s;

}  // namespace

FileLock::FileLock(const std::filesystem::path& path, Kind kind)
{
    file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0)
        throw Unavailable(path.string() + " cannot be written: " + std::strerror(errno));
    const int wanted = (kind == Kind::exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB;
    const auto until = std::chrono::steady_clock::now() + patience;
    while (flock(file_, wanted) != 0) {
        if (errno == EINTR)
            continue;
        if (errno != EWOULDBLOCK)
            return;  // no locks on this file system
        if (std::chrono::steady_clock::now() >= until) {
            close(file_);
            throw Unavailable("another process is at work on the sweep in " +
                              path.parent_path().string());
        }
        std::this_thread::sleep_for(50ms);
    }
}

FileLock::~FileLock() { close(file_); }

}  // namespace bvhbench
