// SPDX-License-Identifier: MIT
#pragma once

#include "device/buffer.h"

namespace bvhbench {

/// When a sort is to end at once, found out on the device (idle.clh).
struct SortUnlessIdle {
    Buffer<uint> unsorted = {};
    uint build = 0;  ///< 0: never
};

}  // namespace bvhbench
