// SPDX-License-Identifier: MIT
#include "scenes/worker/process.h"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>

#include "scenes/worker/worker.h"

namespace bvhbench {
namespace {

using Clock = std::chrono::steady_clock;

/// Reads to the end of the pipe. False if `until` comes first.
bool drain(Child& child, Clock::time_point until)
{
    while (true) {
        const Clock::time_point now = Clock::now();
        if (now >= until)  // whatever has come in the meantime
            return false;
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(until - now).count();
        pollfd waiting{child.reader(), POLLIN, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(std::clamp<long>(left, 0, 1 << 30)));
        if (ready < 0 && errno == EINTR)
            continue;
        if (ready <= 0)
            return false;
        if (!child.take())
            return true;
    }
}

}  // namespace

ProcessEnd run_process(const std::vector<std::string>& command, double time_limit_s,
                       const std::string& extra_environment)
{
    const auto until =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(std::min(time_limit_s, 1e6)));
    Child child({.path = command.front(),
                 .words = command,
                 .environment = {extra_environment, ends_with_this_process()}});
    const bool finished = drain(child, until);
    if (!finished)
        child.send(SIGKILL);
    ProcessEnd end = child.wait();
    if (!finished)
        end.how = ProcessEnd::How::timed_out;
    return end;
}

}  // namespace bvhbench
