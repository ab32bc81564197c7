// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace bvhbench {

/// Returns what a file has that assimp 5.2.5 reads wrong or leaves out without a word, for a refusal; empty if nothing is known.
/// `extension` is in small letters, such as ".dae".
std::string assimp_fault(std::string_view bytes, std::string_view extension);

}  // namespace bvhbench
