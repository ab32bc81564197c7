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

/// FCL's models in double, on one core of the host: pairs of triangles that intersect and share no vertex. The trees are
/// built each query; or refit, the topology being that of the points they were reserved for. They throw BadUsage if
/// adjacent pairs are to be kept. nullptr in a binary built without FCL.
#if BVHBENCH_HAS_FCL
std::unique_ptr<Collider> make_fcl_collider(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_fcl_refit_collider(Programs& programs,
                                                  const ColliderOptions& options);
#else
inline constexpr MakeCollider make_fcl_collider = nullptr;
inline constexpr MakeCollider make_fcl_refit_collider = nullptr;
#endif

}  // namespace bvhbench
