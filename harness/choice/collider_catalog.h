// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "collide/collider.h"
#include "collide/skips.h"

namespace bvhbench {

/// A line of `list colliders`.
struct ColliderEntry {
    std::string_view name;         ///< the key on the command line and in result files
    std::string_view summary;      ///< one line
    MakeCollider make;             ///< nullptr when this binary was built without it
    std::string_view absent = {};  ///< then: why, as in "built without Embree"
    std::size_t host_bytes = 0;    ///< a triangle's, about, of what a library takes on the host
    bool is_library = false;       ///< the work is done by somebody else's code
    // As its collider says itself:
    bool needs_tree = true;       ///< whether it queries a builder's tree
    bool finds_contacts = false;  ///< contacts at once, and no pairs of boxes
};

/// Every collider, in the order tables list them.
std::span<const ColliderEntry> collider_catalog();

/// By name. Throws BadUsage with the known names when there is none.
const ColliderEntry& find_collider(std::string_view name);

/// Which collider, set up how: what the command line and experiment files choose. Owns its words.
struct ColliderChoice {
    std::string name;
    Among among = Among::all;
    bool keep_adjacent = true;
    std::string narrow = "none";  ///< the narrow phase behind it: none or of narrow_methods.h
    unsigned jump = 0;
    unsigned start_level = 0;
    unsigned group_size = 0;
    unsigned rules_off = 0;  ///< of collide/skips.h
    // What only tests and `stress` choose: no result file tells them.
    KernelForm form = KernelForm::of_device;
    std::size_t capacity = 0;

    bool operator==(const ColliderChoice&) const = default;
    ColliderOptions options() const
    {
        return {.among = among,
                .keep_adjacent = keep_adjacent,
                .jump = jump,
                .start_level = start_level,
                .rules_off = rules_off,
                .group_size = group_size,
                .form = form,
                .capacity = capacity};
    }
};

/// Throws BadUsage when no collider is called so, Unavailable when this binary was built without it, and BadUsage for
/// options that it cannot keep.
std::unique_ptr<Collider> make_collider(std::string_view name, Programs& programs,
                                        const ColliderOptions& options);

/// The collider chosen. Throws as the one above.
std::unique_ptr<Collider> make_collider(const ColliderChoice& choice, Programs& programs);

}  // namespace bvhbench
