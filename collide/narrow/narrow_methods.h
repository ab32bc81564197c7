// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace bvhbench {

/// A method that decides which triangles intersect, selected by `--narrow` and the key `narrow`.
struct NarrowMethod {
    std::string_view name;
    std::string_view summary;   ///< one line, for listings
    bool is_exact;              ///< exact for the coordinates as stored; false: can be wrong
    unsigned rounded_test = 0;  ///< ROUNDED_TEST of rounded.clh; 0: exact method
    unsigned real_bits = 0;     ///< REAL_BITS of rounded.clh
};

/// All narrow phases, in the order of tables.
std::span<const NarrowMethod> narrow_methods();

/// Returns the method of this name; "exact" selects the exact one. Throws BadUsage, with the known names, if there is none.
const NarrowMethod& find_narrow_method(std::string_view name);

/// Throws BadUsage unless `name` is "none" or a method's; also if the method cannot keep pairs that share corners as asked.
void check_narrow(std::string_view name, bool keep_adjacent);

}  // namespace bvhbench
