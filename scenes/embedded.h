// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace bvhbench {

/// Returns the text of a file that was compiled into the program, by its path from the source root; nothing if there is none.
std::optional<std::string_view> embedded_scene_text(std::string_view path);

}  // namespace bvhbench
