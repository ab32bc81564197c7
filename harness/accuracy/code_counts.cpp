// SPDX-License-Identifier: MIT
#include "harness/accuracy/code_counts.h"

#include <algorithm>
#include <vector>

namespace bvhbench {

CodeCounts code_counts(const OrderEntry& order, std::span<const Point> points,
                       std::span<const Face> faces)
{
    Bounds bounds = empty_bounds();
    for (const Face& face : faces)
        bounds = grown(bounds, face_box(points, face));
    std::vector<ulong> codes;
    codes.reserve(faces.size());
    for (const Face& face : faces)
        codes.push_back(order.code(face_box(points, face), bounds));
    std::sort(codes.begin(), codes.end());
    CodeCounts counts;
    std::size_t run = 0;
    for (std::size_t k = 0; k < codes.size(); ++k) {
        const bool is_again = k > 0 && codes[k] == codes[k - 1];
        run = is_again ? run + 1 : 1;
        counts.duplicates += is_again ? 1 : 0;
        counts.longest_run = std::max(counts.longest_run, run);
    }
    return counts;
}

}  // namespace bvhbench
