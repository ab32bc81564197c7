// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

namespace bvhbench {

/// Bytes that the host can give without trouble, or nothing where the system does not say. Linux promises more, and
/// ends the process that uses it.
std::optional<std::size_t> available_host_memory();

}  // namespace bvhbench
