// SPDX-License-Identifier: MIT
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "builders/builder.h"
#include "collide/collider.h"
#include "collide/narrow/narrow_methods.h"
#include "collide/skips.h"
#include "plugins/methods.h"

namespace bvhbench {

/// An entry of the builder catalog, printed by `list builders`.
struct BuilderEntry {
    std::string_view name;     ///< name on the command line, in result files and in legends
    std::string_view summary;  ///< one line
    /// Builder whose tree this builder's must equal bit for bit. Empty: only the builder's invariants are checked.
    std::string_view oracle;
    MakeBuilder make;              ///< nullptr if this binary was built without the builder
    std::string_view absent = {};  ///< reason if `make` is nullptr: "built without Embree"
    /// Reason for which the builder may throw Unavailable for some meshes; empty if it never does. It then throws instead of
    /// leaving a wrong tree, and never for an ordinary mesh.
    std::string_view may_refuse = {};
    bool is_library = false;     ///< the work is done by a third-party library
    bool takes_formats = false;  ///< whether its tree can hold boxes in any of box_formats()
    bool own_order = false;      ///< whether it ignores BuildOptions::order
    const outside::Offer* outside = nullptr;  ///< of a method from outside, which has no `make`
    /// Its plug-in, as far as can be told, does not start: `absent` says why.
    bool is_broken = false;

    /// True if it can be made.
    bool is_there() const { return make != nullptr || outside != nullptr; }
};

/// Returns every builder, in the order of printed tables. Those from outside are last.
std::span<const BuilderEntry> builder_catalog();

/// Returns the builder called `name`. Throws BadUsage with the known names if there is none. If a plug-in does not start, the name
/// may be one of its: the entry is then broken.
const BuilderEntry& find_builder(std::string_view name);

/// What a cell measures: a build, a refit of an existing tree, a whole frame (tree update and query), or errors along an axis of
/// accuracy.
enum class Operation { build, refit, collide, accuracy, cluster };

/// Returns the operation's name in experiments and result files.
constexpr std::string_view operation_name(Operation operation)
{
    constexpr std::string_view names[] = {"build", "refit", "collide", "accuracy", "cluster"};
    return names[static_cast<std::size_t>(operation)];
}

/// A builder and its options, as chosen on the command line or in an experiment.
struct BuilderChoice : BuildOptions {
    std::string name;

    bool operator==(const BuilderChoice&) const = default;
};

/// Throws BadUsage if there is no such builder or box format, or if the builder or its leaf placement does not allow the format.
void check_boxes(const BuilderChoice& choice);

/// Throws BadUsage if there is no such builder or it does not support the boxes; Unavailable if this binary lacks it.
std::unique_ptr<Builder> make_builder(const BuilderChoice& choice, Programs& programs);

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
    const outside::Offer* outside = nullptr;  ///< of a method from outside, which has no `make`
    bool refits = false;  ///< keeps trees or a front from frame to frame, over the same triangles
    bool is_broken = false;   ///< as that of a builder
    bool filters = false;     ///< whether it leaves out what ColliderOptions::filter does
    bool ends_early = false;  ///< whether it can end at the first contact

    /// True if it can be made.
    bool is_there() const { return make != nullptr || outside != nullptr; }
};

/// Returns every collider, in the order of printed tables. Those from outside are last.
std::span<const ColliderEntry> collider_catalog();

/// Returns the collider called `name`, as find_builder does.
const ColliderEntry& find_collider(std::string_view name);

/// How a builder's trees follow the points from frame to frame.
enum class FrameUpdate {
    automatic,  ///< rebuilt, unless a rule of collide/skips.h or the collider allows less
    rebuild,    ///< rebuilt in every frame; a collider that carries state forgets it
    refit,      ///< built in the first frame and refitted in all others
};

/// What one of a builder's trees is over. Automatic: `collide` and experiments choose by the scene (one_tree.h); elsewhere, each object.
enum class TreeOver { object, scene, automatic };

/// A collider and its options, as chosen on the command line or in an experiment. Result files do not store `form` and `capacity`,
/// which only tests and `stress` set.
struct ColliderChoice : ColliderOptions {
    std::string name;
    std::string narrow = "none";  ///< narrow phase: "none" or a name of narrow_methods.h
    unsigned rules_forced = 0;    ///< rules used although the device does without them by default
    FrameUpdate update = FrameUpdate::automatic;
    TreeOver trees = TreeOver::object;
    /// How far apart pairs may be, as it was asked for (distance_words.h).
    std::string within = "none";
    /// How near features that touch in a step may be, as it was asked for; "none" as 0.
    std::string separation = "none";
    /// The one of both that was asked for, in the scene's unit; nothing if neither was, or a separation of 0.
    std::optional<double> distance = std::nullopt;

    bool operator==(const ColliderChoice&) const = default;

    bool is_within() const { return within != "none"; }

    /// What the narrow phase decides, of swept boxes or others.
    NarrowOf question(bool swept) const
    {
        return swept ? NarrowOf::step : is_within() ? NarrowOf::distance : NarrowOf::moment;
    }
};

/// Makes the chosen collider. Throws BadUsage if there is none, it does not support the options or the narrow phase is
/// unsuitable, and Unavailable if this binary was built without it.
std::unique_ptr<Collider> make_collider(const ColliderChoice& choice, Programs& programs);

/// True if boxes are rounded outward, by their format or by a collider from outside, so that more pairs are found than overlap.
bool widens_boxes(const BuilderChoice& builder, const ColliderChoice& collider);

/// Adds the methods of a library from outside to both catalogs, with what its processes may take. Called before the catalogs are
/// used, because they do not change afterwards. Throws BadUsage if a name is taken, and then adds nothing.
void add_outside(outside::Library library, const outside::Limits& limits);

/// Notes that a plug-in does not start, and why. Names that no other plug-in has may be its.
void add_broken_outside(const std::string& why);

/// True if a plug-in does not start.
bool has_broken_outside();

/// True if the catalogs have a method from outside.
bool has_outside();

/// Returns all methods from outside.
const std::list<outside::Offer>& outside_offers();

/// Returns the library of the method `name` from outside; nullptr if it is none.
const outside::Library* outside_library(std::string_view name);

}  // namespace bvhbench
