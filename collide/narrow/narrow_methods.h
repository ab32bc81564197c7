// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace bvhbench {

/// A method that decides which triangles intersect at one moment, or which swept vertices, edges and faces touch between two
/// frames, selected by `--narrow` and the key `narrow`.
struct NarrowMethod {
    std::string_view name;
    std::string_view summary;   ///< one line, for listings
    bool is_exact;              ///< exact for the coordinates as stored; false: can be wrong
    unsigned rounded_test = 0;  ///< ROUNDED_TEST of rounded.clh; 0: exact method
    unsigned real_bits = 0;     ///< REAL_BITS of rounded.clh
    /// Of a method for swept boxes: features that come nearer than this share of the scene's longest side may be taken to touch.
    float tolerance = 0;

    bool is_swept() const { return tolerance > 0; }
};

/// All narrow phases, in the order of tables: those of one moment, then those between two frames.
std::span<const NarrowMethod> narrow_methods();

/// The two parts of narrow_methods().
std::span<const NarrowMethod> moment_narrow_methods();
std::span<const NarrowMethod> swept_narrow_methods();

/// Returns the method of this name; "exact" selects the exact one. Throws BadUsage, with the known names, if there is none.
const NarrowMethod& find_narrow_method(std::string_view name);

/// Throws BadUsage unless `name` is "none" or a method's; also if the method cannot keep pairs that share corners as asked.
void check_narrow(std::string_view name, bool keep_adjacent);

/// Throws BadUsage if the method `name`, which may be "none", is for one moment and boxes are swept, or the other way round.
void check_narrow_of(std::string_view name, bool swept);

}  // namespace bvhbench
