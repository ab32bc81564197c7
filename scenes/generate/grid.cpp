// SPDX-License-Identifier: MIT
#include "scenes/generate/generators.h"
#include "scenes/generate/patch.h"

namespace bvhbench {

Mesh make_grid(uint triangles)
{
    return make_patch(triangles, [](std::size_t i, std::size_t w, std::size_t j, std::size_t h) {
        return Point{static_cast<float>(i) / static_cast<float>(w),
                     static_cast<float>(j) / static_cast<float>(h), 0.0f};
    });
}

}  // namespace bvhbench
