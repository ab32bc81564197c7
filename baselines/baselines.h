// SPDX-License-Identifier: MIT
//
// The builders and colliders that the paper's are compared with.
#pragma once

#include <memory>
#include <string_view>

#include "builders/builder.h"
#include "collide/collider.h"

namespace bvhbench {

/// The perfect implicit tree, padded to a power of two leaves: the first row of Table 1.
std::unique_ptr<Builder> make_perfect(Programs& programs, const BuildOptions& options);

/// Top-down builders on one core of the host, with one triangle per leaf. They compute no codes, so `order` is ignored.
std::unique_ptr<Builder> make_heap_median(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_median_split(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_sah_binned(Programs& programs, const BuildOptions& options);

/// The binary radix tree of [Karras2012]: the topology of all inner nodes in parallel, then boxes bottom-up.
std::unique_ptr<Builder> make_karras(Programs& programs, const BuildOptions& options);

/// The binary radix tree, built bottom-up as printed in [Apetrei2014]: the second row of Table 1.
std::unique_ptr<Builder> make_apetrei(Programs& programs, const BuildOptions& options);

/// The binary radix tree with topology and boxes in one launch: the fastest known form of [Apetrei2014].
std::unique_ptr<Builder> make_apetrei_fused(Programs& programs, const BuildOptions& options);

/// The binary radix tree with one launch per level, topology top-down and boxes bottom-up, similar to [Lauterbach2009].
std::unique_ptr<Builder> make_lbvh_levels(Programs& programs, const BuildOptions& options);

/// The binary radix tree, built top-down on one core of the host. Slow; the oracle for all builders of this tree.
std::unique_ptr<Builder> make_radix_reference(Programs& programs, const BuildOptions& options);

/// The radix tree's ranges joined anew by surface area, bottom-up in one launch, as in [Benthin2024].
std::unique_ptr<Builder> make_hploc(Programs& programs, const BuildOptions& options);

/// The same tree on one core of the host. Slow; the oracle.
std::unique_ptr<Builder> make_hploc_reference(Programs& programs, const BuildOptions& options);

// For a library that the program was built without, all its make_ functions are nullptr and `..._absent` gives the reason. Test
// `..._absent`: with its undefined-behaviour sanitizer, GCC 12 does not treat a function's address as a constant.
#if BVHBENCH_HAS_EMBREE
inline constexpr std::string_view embree_absent = {};

/// Embree's rtcBuildBVH on all threads of the host, with binary nodes and one triangle per leaf. High quality runs without
/// spatial splits, which put a triangle in several leaves, and then builds as medium quality does. A build throws Unavailable
/// for coordinates beyond 1.8e18.
std::unique_ptr<Builder> make_embree_low(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_embree_medium(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_embree_high(Programs& programs, const BuildOptions& options);

/// Embree's rtcCollide over user geometry, on all threads of the host. Finds pairs of overlapping boxes. `embree` builds its
/// trees for each query; `embree-refit` refits trees whose topology comes from the points given to `reserve`. `query`, and
/// `reserve` of `embree-refit`, throw Unavailable for coordinates beyond 1.8e18.
std::unique_ptr<Collider> make_embree_collider(Programs& programs, const ColliderOptions& options);
std::unique_ptr<Collider> make_embree_refit_collider(Programs& programs,
                                                     const ColliderOptions& options);
#else
inline constexpr std::string_view embree_absent = "built without Embree";
inline constexpr MakeBuilder make_embree_low = nullptr;
inline constexpr MakeBuilder make_embree_medium = nullptr;
inline constexpr MakeBuilder make_embree_high = nullptr;
inline constexpr MakeCollider make_embree_collider = nullptr;
inline constexpr MakeCollider make_embree_refit_collider = nullptr;
#endif

#if BVHBENCH_HAS_FCL
inline constexpr std::string_view fcl_absent = {};

/// FCL's BVHModel in double precision, on one core of the host.
std::unique_ptr<Builder> make_fcl_aabb(Programs& programs, const BuildOptions& options);
std::unique_ptr<Builder> make_fcl_obbrss(Programs& programs, const BuildOptions& options);

/// FCL's collision of BVHModels, boxes in floats and triangles in doubles, on all cores of the host. Finds pairs of triangles that
/// intersect and share no vertex. `fcl` builds its trees for each query; `fcl-refit` refits trees whose topology comes from the points given
/// to `reserve`. Both throw BadUsage if adjacent pairs are to be kept.
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
