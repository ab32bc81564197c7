// SPDX-License-Identifier: MIT
//
// The memory of the host that this process may take. The kernel promises more than there is and ends the process that uses
// it, so whoever needs much asks here first. What nobody foresaw, as in a library, meets RLIMIT_DATA: an allocation fails,
// and that is a sentence too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace bvhbench {

/// From here on this process takes no more than `limit` bytes in all, what it has already among them; of 0, no more than
/// there is. Sets RLIMIT_DATA, so that allocations beyond fail; not under a sanitizer. May be called again, when more
/// is known of what the process has before it measures. Throws Unavailable if the process has more already.
void limit_host_memory(std::uint64_t limit);

/// Bytes that this process can still take: the least of what its limit, the machine, its control groups and RLIMIT_AS
/// leave. A tenth of what the machine and the groups have is left to others. Memory that is mapped and was never written
/// counts as taken.
std::uint64_t host_memory_left();

/// Throws Unavailable, naming `what`, if that is less than `bytes`. Asked before they are taken.
void require_host_memory(std::string_view what, std::uint64_t bytes);

/// What a process was given, foresaw and took, in bytes.
struct HostMemoryFacts {
    std::uint64_t given = 0;  ///< in all, when it was limited last
    /// The most that it had and asked for at once; small amounts are left out.
    std::uint64_t predicted = 0;
    std::uint64_t peak = 0;  ///< the most that was in memory: VmHWM
};
HostMemoryFacts host_memory_facts();

/// Bytes that this process may still take before a memory limit of its control group, or of one around it, is reached;
/// nothing where none has a limit. Files that the kernel keeps in memory count as free: it drops them first. Reads
/// cgroup v2 (memory.max) and v1 (memory.limit_in_bytes) below `root`, which is another folder in tests.
std::optional<std::uint64_t> cgroup_memory_left(const std::filesystem::path& root = "/");

}  // namespace bvhbench
