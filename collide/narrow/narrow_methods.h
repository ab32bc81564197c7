// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "collide/narrow/narrow_words.h"

namespace bvhbench {

/// What a narrow phase decides: which triangles intersect at one moment, which vertices, edges and faces touch between two frames, or which
/// triangles are within a distance.
enum class NarrowOf { moment, step, distance };

/// A method that decides one of these, selected by `--narrow` and the key `narrow`.
struct NarrowMethod {
    std::string_view name;
    std::string_view summary;   ///< one line, for listings
    bool is_exact;              ///< exact for the coordinates as stored; false: can be wrong
    unsigned rounded_test = 0;  ///< ROUNDED_TEST of rounded.clh; 0: none
    unsigned real_bits = 0;     ///< precision of what it computes
    /// Of a method for swept boxes: features that come nearer than this share of the scene's longest side may be taken to touch.
    float tolerance = 0;

    unsigned within_test = 0;  ///< of a method for distances: WITHIN_ of narrow_words.h

    NarrowOf of() const
    {
        return tolerance > 0      ? NarrowOf::step
               : within_test != 0 ? NarrowOf::distance
                                  : NarrowOf::moment;
    }

    /// True of methods with the filters of verdict.clh. What these leave open is decided exactly, or taken for a contact.
    bool is_filter() const { return of() == NarrowOf::moment && rounded_test == 0; }

    bool misses_none() const { return rounded_test == 0 && within_test != WITHIN_COMPUTED; }
};

/// All narrow phases, in the order of tables: those of one moment, between two frames, and for distances.
std::span<const NarrowMethod> narrow_methods();
std::span<const NarrowMethod> narrow_methods(NarrowOf question);

/// Returns the method of this name; "exact" selects the exact one. Throws BadUsage, with the known names, if there is none.
const NarrowMethod& find_narrow_method(std::string_view name);

/// Throws BadUsage unless `name` is "none" or a method's; also if the method cannot keep pairs that share corners as asked.
void check_narrow(std::string_view name, bool keep_adjacent);

/// Throws BadUsage for a minimum separation that is negative or not finite.
void check_separation(double separation);

/// Throws BadUsage if there is no narrow phase or no swept box that a minimum separation can be beside.
void check_separation(std::string_view narrow, bool is_swept);

/// Throws BadUsage if the method `name`, which may be "none", does not decide `question`. The exact one is for distances too.
void check_narrow_of(std::string_view name, NarrowOf question);

}  // namespace bvhbench
