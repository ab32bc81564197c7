// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// The connected part that each triangle is of; parts are numbered in the order of their first triangles.
struct Parts {
    std::vector<uint> of_face;
    uint count = 0;
};

/// Two triangles that name a common vertex are of one part.
Parts parts_of(const std::vector<Face>& faces, std::size_t vertices);

}  // namespace bvhbench
