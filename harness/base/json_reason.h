// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>

namespace bvhbench {

/// What the JSON library found wrong, for a sentence: without its number for the fault, on one line, printable, and not long.
std::string json_reason(const std::exception& error);

}  // namespace bvhbench
