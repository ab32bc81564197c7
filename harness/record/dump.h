// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "builders/tree.h"

namespace bvhbench {

/// A spelled-out tree as JSON, root first, -1 for none, numbers with the digits that give their bits back:
/// {"nodes":[{"box":{"min":[x,y,z],"max":[x,y,z]},"child":[a,b],"primitive":k}]}
std::string dump_text(const HostTree& tree);

}  // namespace bvhbench
