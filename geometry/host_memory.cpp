// SPDX-License-Identifier: MIT
#include "geometry/host_memory.h"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <limits>
#include <string>

#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

// A limit applies to the whole process, and so do these values.
std::atomic<std::uint64_t> given = 0, predicted = 0, most_data = no_limit;

/// Bytes that may be requested before the host's memory is checked again: a sixteenth of what was left at the last check. A
/// check reads some 20 files of /proc and of the control groups, and most requests are small.
std::atomic<std::uint64_t> unasked = 0;

bool take_unasked(std::uint64_t bytes)
{
    for (std::uint64_t there = unasked; bytes <= there;)
        if (unasked.compare_exchange_weak(there, there - bytes))
            return true;
    return false;
}

/// Returns the value in bytes of a line "VmRSS:  123 kB" of a file of /proc; `otherwise` if there is no such line.
std::uint64_t bytes_in(const char* path, std::string_view key, std::uint64_t otherwise)
{
    std::ifstream file(path);
    for (std::string word; file >> word;) {
        std::uint64_t kib = 0;
        if (word == key && file >> kib)
            return kib * 1024;
        file.ignore(4096, '\n');
    }
    return otherwise;
}

std::uint64_t own(std::string_view key) { return bytes_in("/proc/self/status", key, 0); }

std::uint64_t left_of(int resource, std::string_view used)
{
    rlimit limit = {};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return no_limit;
    return limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, own(used));
}

/// Returns the bytes that other processes leave to this one.
std::uint64_t left_by_others()
{
    const std::uint64_t machine = bytes_in("/proc/meminfo", "MemAvailable:", no_limit);
    const std::uint64_t left = std::min(machine, cgroup_memory_left().value_or(no_limit));
    return std::min(left / 10 * 9, left_of(RLIMIT_AS, "VmSize:"));
}

/// Makes allocations fail once the process has `more` bytes beyond what it has now.
void limit_data(std::uint64_t more)
{
    const std::uint64_t has = own("VmData:");
    most_data = has + std::min(more, no_limit - has);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers map terabytes
    rlimit limit = {};
    if (getrlimit(RLIMIT_DATA, &limit) != 0)
        return;
    limit.rlim_cur = std::min<std::uint64_t>(limit.rlim_max, most_data);
    setrlimit(RLIMIT_DATA, &limit);
#endif
}

}  // namespace

void limit_host_memory(std::uint64_t limit)
{
    const std::uint64_t has = own("VmRSS:");
    if (limit != 0 && has >= limit)
        throw Unavailable("out of host memory: the program itself takes " + std::to_string(has) +
                          " bytes, and the limit is " + std::to_string(limit));
    const std::uint64_t left = std::min(limit == 0 ? no_limit : limit - has, left_by_others());
    limit_data(left);
    given = has + left;
    unasked = 0;
}

std::uint64_t host_memory_left()
{
    const std::uint64_t most = most_data;
    return std::min(
        {most - std::min(most, own("VmData:")), left_of(RLIMIT_DATA, "VmData:"), left_by_others()});
}

void require_host_memory(std::string_view what, std::uint64_t bytes)
{
    if (take_unasked(bytes))
        return;
    std::uint64_t left = host_memory_left();
    if (bytes > left) {
        malloc_trim(0);  // returns freed memory to the system
        left = host_memory_left();
    }
    if (bytes > left)
        throw Unavailable("out of host memory: " + std::string(what) + " takes about " +
                          std::to_string(bytes) + " bytes, and the host gives " +
                          std::to_string(left));
    const std::uint64_t then = own("VmRSS:") + bytes;
    for (std::uint64_t most = predicted;
         most < then && !predicted.compare_exchange_weak(most, then);) {
    }
    unasked = (left - bytes) / 16;
}

HostMemoryFacts host_memory_facts() { return {given, predicted, own("VmHWM:")}; }

}  // namespace bvhbench
