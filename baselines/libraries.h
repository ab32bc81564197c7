// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace bvhbench {

/// Why nothing of a library can be made; empty if the program was built with it. Not found out from makers that are
/// nullptr: GCC 12 takes no function's address for a constant under its undefined-behaviour sanitizer.
#if BVHBENCH_HAS_EMBREE
inline constexpr std::string_view embree_absent = {};
#else
inline constexpr std::string_view embree_absent = "built without Embree";
#endif
#if BVHBENCH_HAS_FCL
inline constexpr std::string_view fcl_absent = {};
#else
inline constexpr std::string_view fcl_absent = "built without FCL";
#endif

}  // namespace bvhbench
