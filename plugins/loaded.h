// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "plugins/protocol.h"

namespace bvhbench::outside {

/// Loads a shared library with the interface in C, and returns what replies to requests and in the end destroys the state of its method.
/// Both throw Unavailable, with a sentence: if it is no such library or has another interface, or for what it says.
std::function<Json(const Json&)> loaded_library(const char* path);

}  // namespace bvhbench::outside
