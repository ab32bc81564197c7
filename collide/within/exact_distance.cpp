// SPDX-License-Identifier: MIT
#include "collide/within/exact_distance.h"

#include "collide/within/exact_corners.h"

namespace bvhbench {

bool parted_within(const Corners& a, const Corners& b, double distance)
{
    const ExactCorners exact(a, b, distance);
    const Integer reach(distance, exact.unit), most = reach * reach;
    return any_way(exact.a, exact.b, [&](const Integer& over, const Integer& under, const auto&) {
        return over <= most * under;
    });
}

}  // namespace bvhbench
