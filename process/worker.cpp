// SPDX-License-Identifier: MIT
#include "process/worker.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "process/child.h"

namespace bvhbench {

void limit_worker(std::size_t memory_bytes)
{
    end_with_parent();
    leave_no_core();
    limit_host_memory(std::min<std::uint64_t>(memory_bytes, host_memory_left()));
}

int take_standard_output()
{
    const int answer = dup(STDOUT_FILENO);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    return answer;
}

MemoryFile::MemoryFile(std::string_view bytes) : file_(memfd_create("bvhbench", MFD_CLOEXEC))
{
    if (file_ >= 0 && write_all(file_, bytes))
        return;
    const std::string reason = std::strerror(errno);
    close(file_);
    throw Unavailable("no file can be made in memory: " + reason);
}

MemoryFile::~MemoryFile() { close(file_); }

std::string MemoryFile::path() const
{
    return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file_);
}

std::size_t MemoryFile::size() const
{
    struct stat facts = {};
    return fstat(file_, &facts) == 0 ? static_cast<std::size_t>(facts.st_size) : 0;
}

bool MemoryFile::read(void* to, std::size_t bytes) const
{
    for (std::size_t done = 0; done < bytes;) {
        const ssize_t count =
            pread(file_, static_cast<char*>(to) + done, bytes - done, static_cast<off_t>(done));
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return false;
        done += static_cast<std::size_t>(count);
    }
    return true;
}

bool write_all(int file, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = write(file, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return false;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

}  // namespace bvhbench
