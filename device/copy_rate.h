// SPDX-License-Identifier: MIT
#pragma once

#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// What the device's memory gives at best, measured: the yardstick that stage times are held against.
struct CopyRate {
    /// Bytes read plus bytes written, over the median device time; 0 if the device's clock showed none.
    double bytes_per_s = 0;
    std::size_t buffer_bytes = 0;  ///< size of the source, larger than the caches
    int samples = 0;
};

/// Copy one large buffer to another with a plain 16-byte kernel, several times.
CopyRate measure_copy_rate(Programs& programs, Queue& queue);

}  // namespace bvhbench
