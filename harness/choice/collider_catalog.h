// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "collide/collider.h"
#include "collide/skips.h"

namespace bvhbench {

/// An entry of the collider catalog, printed by `list colliders`.
struct ColliderEntry {
    std::string_view name;         ///< name on the command line and in result files
    std::string_view summary;      ///< one line
    MakeCollider make;             ///< nullptr if this binary was built without the collider
    std::string_view absent = {};  ///< reason if `make` is nullptr: "built without Embree"
    std::size_t host_bytes = 0;    ///< host memory of a library, in bytes per triangle, roughly
    bool is_library = false;       ///< the work is done by a third-party library
    // These equal what the collider itself returns.
    bool needs_tree = true;       ///< whether it queries a builder's tree
    bool finds_contacts = false;  ///< finds intersecting triangles directly, without box pairs
};

/// Returns every collider, in the order of printed tables.
std::span<const ColliderEntry> collider_catalog();

/// Returns the collider called `name`. Throws BadUsage with the known names if there is none.
const ColliderEntry& find_collider(std::string_view name);

/// A collider and its options, as chosen on the command line or in an experiment. Owns its strings.
struct ColliderChoice {
    std::string name;
    Among among = Among::all;
    bool keep_adjacent = true;
    std::string narrow = "none";  ///< narrow phase: "none" or a name of narrow_methods.h
    unsigned jump = 0;
    unsigned start_level = 0;
    unsigned group_size = 0;
    unsigned rules_off = 0;  ///< disabled rules, bits of collide/skips.h
    // Only tests and `stress` set these; result files do not store them.
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

/// Throws BadUsage if there is no such collider or it does not support the options, and Unavailable if this binary was built
/// without it.
std::unique_ptr<Collider> make_collider(std::string_view name, Programs& programs,
                                        const ColliderOptions& options);

/// Makes the chosen collider. Throws as above, and BadUsage for an unsuitable narrow phase.
std::unique_ptr<Collider> make_collider(const ColliderChoice& choice, Programs& programs);

}  // namespace bvhbench
