// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "python/arrays.h"

namespace bvhbench::python {

/// Returns the right answer to a query for `answer`, pairs, contacts or within, over one object: by a sweep and exact tests on the host,
/// without any tree. Sorted, a row each. Releases the GIL. Faces must name points that there are, and points must be finite.
Numbers right_pairs(const std::string& answer, const Floats& points, const Numbers& faces,
                    bool adjacent, double distance);

}  // namespace bvhbench::python
