// SPDX-License-Identifier: MIT
//
// Limits for the host memory of this process. Linux grants more memory than exists and kills the process that uses it, so
// large allocations are checked here first. Allocations that are not checked, such as those of libraries, fail at RLIMIT_DATA
// and are reported as errors too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace bvhbench {

/// Limits this process to `limit` bytes in total, including what it already has; 0 limits it to the memory available. Sets
/// RLIMIT_DATA, so that allocations beyond the limit fail (not under a sanitizer). May be called again, when the memory that
/// the process needs before it measures is known. Throws Unavailable if the process already has more.
void limit_host_memory(std::uint64_t limit);

/// Returns the bytes that this process can still take: the minimum over its limit, the machine, its control groups and
/// RLIMIT_AS. A tenth of the memory left in the machine and the groups is reserved for other processes. Memory that is mapped
/// but was never written counts as taken.
std::uint64_t host_memory_left();

/// Throws Unavailable, naming `what`, if host_memory_left() is less than `bytes`. Called before an allocation.
void require_host_memory(std::string_view what, std::uint64_t bytes);

/// Memory limit, predicted and actual peak of this process, in bytes.
struct HostMemoryFacts {
    std::uint64_t given = 0;  ///< total limit that the last limit_host_memory set
    /// Largest sum of memory in use and a request; small requests are not recorded.
    std::uint64_t predicted = 0;
    std::uint64_t peak = 0;  ///< largest resident size so far (VmHWM)
};
HostMemoryFacts host_memory_facts();

/// Returns the bytes that this process may still take before it reaches a memory limit of its control group or of an enclosing
/// one; nothing if no group has a limit. The page cache counts as free, because the kernel drops it first. Reads cgroup v2
/// (memory.max) and v1 (memory.limit_in_bytes) below `root`; tests pass another folder.
std::optional<std::uint64_t> cgroup_memory_left(const std::filesystem::path& root = "/");

}  // namespace bvhbench
