// SPDX-License-Identifier: MIT
#include "scenes/worker/worker.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

constexpr const char* parent = "BVHBENCH_PARENT";

}  // namespace

std::string ends_with_this_process()
{
    return std::string(parent) + '=' + std::to_string(getpid());
}

void end_with_parent()
{
    const char* const wanted = std::getenv(parent);
    if (wanted == nullptr)
        return;
    const long process = std::strtol(wanted, nullptr, 10);
    unsetenv(parent);  // it says nothing to those that this one starts
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != process)  // it was over before the line above
        _exit(128 + SIGKILL);
}

void limit_worker(std::size_t memory_bytes)
{
    end_with_parent();
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
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
