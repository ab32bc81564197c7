// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace bvhbench {

/// The text of a file that was compiled in, by its path from the source root.
std::optional<std::string_view> embedded_scene_text(std::string_view path);

}  // namespace bvhbench
