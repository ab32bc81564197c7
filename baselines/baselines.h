// SPDX-License-Identifier: MIT
//
// Everything the paper's builders and colliders are compared with.
#pragma once

#include <memory>
#include <string_view>

#include "builders/builder.h"
#include "collide/collider.h"

namespace bvhbench {

/// The perfect implicit tree, padded to a power of two leaves: Table 1's first row.
std::unique_ptr<Builder> make_perfect(Programs& programs, const BuildOptions& options);

/// On one core of the host, from the root down, one triangle a leaf. They take no order: no code is computed.
std::unique_ptr<Builder> make_heap_median(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_median_split(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_sah_binned(Programs& programs, const BuildOptions& options);

/// The binary radix tree of [Karras2012]: topology top-down from all nodes at once, then boxes bottom-up.
std::unique_ptr<Builder> make_karras(Programs& programs, const BuildOptions& options);

/// The same tree bottom-up, as [Apetrei2014] prints it: Table 1's second row.
std::unique_ptr<Builder> make_apetrei(Programs& programs, const BuildOptions& options);

/// The same, topology and boxes in one launch: the strongest form of [Apetrei2014] we know.
std::unique_ptr<Builder> make_apetrei_fused(Programs& programs, const BuildOptions& options);

/// The same, a launch a level: top-down the topology, bottom-up the boxes, in the manner of [Lauterbach2009].
std::unique_ptr<Builder> make_lbvh_levels(Programs& programs, const BuildOptions& options);

/// The same tree top-down on one core of the host, slowly: the oracle for every builder of it.
std::unique_ptr<Builder> make_radix_reference(Programs& programs, const BuildOptions& options);

// Of libraries that the program was built without, all that makes something is nullptr and `..._absent` says why. Ask the
// latter: under its undefined-behaviour sanitizer GCC 12 takes no function's address for a constant.
#if BVHBENCH_HAS_EMBREE
inline constexpr std::string_view embree_absent = {};

/// rtcBuildBVH, on all threads of the host, with binary nodes and one triangle a leaf. High quality is denied its
/// splits, since they put a triangle in several leaves, and then builds as medium does.
/// They throw Unavailable for coordinates beyond 1.8e18.
std::unique_ptr<Builder> make_embree_low(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_embree_medium(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_embree_high(Programs& programs, const BuildOptions& options);

/// rtcCollide over user geometry, built anew each query, on all threads of the host: pairs of boxes that overlap.
/// Throws Unavailable for coordinates beyond 1.8e18.
std::unique_ptr<Collider> make_embree_collider(Programs& programs, const ColliderOptions& options);
#else
inline constexpr std::string_view embree_absent = "built without Embree";
inline constexpr MakeBuilder make_embree_low = nullptr;
inline constexpr MakeBuilder make_embree_medium = nullptr;
inline constexpr MakeBuilder make_embree_high = nullptr;
inline constexpr MakeCollider make_embree_collider = nullptr;
#endif

#if BVHBENCH_HAS_FCL
inline constexpr std::string_view fcl_absent = {};

/// FCL's BVHModel in double, on one core of the host.
std::unique_ptr<Builder> make_fcl_aabb(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_fcl_obbrss(Programs& programs, const BuildOptions& options);

/// FCL's models in double, on one core of the host: pairs of triangles that intersect and share no vertex. The trees are
/// built each query; or refit, the topology being that of the points they were reserved for. They throw BadUsage if
/// adjacent pairs are to be kept.
std::unique_ptr<Collider> make_fcl_collider(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_fcl_refit_collider(Programs& programs,
                                                  const ColliderOptions& options);
#else
inline constexpr std::string_view fcl_absent = "built without FCL";
inline constexpr MakeBuilder make_fcl_aabb = nullptr;
inline constexpr MakeBuilder make_fcl_obbrss = nullptr;
inline constexpr MakeCollider make_fcl_collider = nullptr;
inline constexpr MakeCollider make_fcl_refit_collider = nullptr;
#endif

}  // namespace bvhbench
