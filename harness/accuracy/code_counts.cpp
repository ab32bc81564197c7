// SPDX-License-Identifier: MIT
#include "harness/accuracy/code_counts.h"

#include <algorithm>
#include <vector>

#include "builders/stages/codes.h"

namespace bvhbench {
namespace {

Bounds bounds_of(std::span<const Point> points, std::span<const Face> faces)
{
    Bounds bounds = empty_bounds();
    for (const Face& face : faces)
        bounds = grown(bounds, face_box(points, face));
    return bounds;
}

/// Add what is equal among `codes`.
void count_equal(std::vector<ulong>& codes, CodeCounts& counts)
{
    std::sort(codes.begin(), codes.end());
    std::size_t run = 0;
    for (std::size_t k = 0; k < codes.size(); ++k) {
        const bool is_again = k > 0 && codes[k] == codes[k - 1];
        run = is_again ? run + 1 : 1;
        counts.duplicates += is_again ? 1 : 0;
        counts.longest_run = std::max(counts.longest_run, run);
    }
}

}  // namespace

CodeCounts code_counts(const OrderEntry& order, std::span<const Point> points,
                       std::span<const Face> faces, std::span<const FaceRange> objects,
                       GridOver grid)
{
    const unsigned dropped = order.code_bits - kept_code_bits(order.code_bits, objects.size());
    const Bounds all = bounds_of(points, faces);
    CodeCounts counts;
    for (const FaceRange& object : objects) {
        const auto own = faces.subspan(object.first, object.count);
        const Bounds bounds = grid == GridOver::scene ? all : bounds_of(points, own);
        std::vector<ulong> codes;
        codes.reserve(own.size());
        for (const Face& face : own)
            codes.push_back(order.code(face_box(points, face), bounds) >> dropped);
        count_equal(codes, counts);
    }
    return counts;
}

}  // namespace bvhbench
