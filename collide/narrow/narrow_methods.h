// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace bvhbench {

/// A way to tell which triangles intersect: what `--narrow` and the key `narrow` choose.
struct NarrowMethod {
    std::string_view name;
    std::string_view summary;  ///< one line, for listings
    bool is_exact;  ///< promises the answer for the coordinates as stored; else errors are counted
    unsigned rounded_test = 0;  ///< ROUNDED_TEST of collide/narrow/rounded.clh; 0: none of these
    unsigned real_bits = 0;     ///< REAL_BITS of it
};

/// Every narrow phase, in the order in which tables list them.
std::span<const NarrowMethod> narrow_methods();

/// By name; "exact" is the one that is. Throws BadUsage with the known names when there is none.
const NarrowMethod& find_narrow_method(std::string_view name);

/// Throws BadUsage unless `name` is none or a method's, and if the method cannot keep pairs that share corners but is
/// asked to.
void check_narrow(std::string_view name, bool keep_adjacent);

}  // namespace bvhbench
