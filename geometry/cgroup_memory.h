// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace bvhbench {

/// Bytes that this process may still take before a memory limit of its control group, or of one around it, is reached;
/// nothing where none has a limit. Files that the kernel keeps in memory count as free: it drops them first. Reads
/// cgroup v2 (memory.max) and v1 (memory.limit_in_bytes) below `root`, which is another folder in tests.
std::optional<std::uint64_t> cgroup_memory_left(const std::filesystem::path& root = "/");

}  // namespace bvhbench
