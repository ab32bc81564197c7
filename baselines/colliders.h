// SPDX-License-Identifier: MIT
//
// What users of a library would find pairs with instead of us.
#pragma once

#include "collide/collider.h"

namespace bvhbench {

/// rtcCollide over user geometry, built anew each query, on all threads of the host: pairs of boxes that overlap.
/// Throws Unavailable for coordinates beyond 1.8e18. nullptr in a binary built without Embree.
#if BVHBENCH_HAS_EMBREE
std::unique_ptr<Collider> make_embree_collider(Programs& programs, const ColliderOptions& options);
#else
inline constexpr MakeCollider make_embree_collider = nullptr;
#endif

/// FCL's models in double, on one core of the host: pairs of triangles that intersect and share no vertex. Throws
/// BadUsage if those that do are to be kept. nullptr in a binary built without it.
#if BVHBENCH_HAS_FCL
std::unique_ptr<Collider> make_fcl_aabb_collider(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_fcl_obbrss_collider(Programs& programs, const ColliderOptions& options);
#else
inline constexpr MakeCollider make_fcl_aabb_collider = nullptr;
inline constexpr MakeCollider make_fcl_obbrss_collider = nullptr;
#endif

}  // namespace bvhbench
