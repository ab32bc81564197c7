// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "builders/builder.h"

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
};

/// Returns every builder, in the order of printed tables.
std::span<const BuilderEntry> builder_catalog();

/// Returns the builder called `name`. Throws BadUsage with the known names if there is none.
const BuilderEntry& find_builder(std::string_view name);

/// What a cell measures: a build, a refit of an existing tree, a whole frame (tree update and query), or errors along an axis of
/// accuracy.
enum class Operation { build, refit, collide, accuracy };

/// Returns the operation's name in experiments and result files.
constexpr std::string_view operation_name(Operation operation)
{
    constexpr std::string_view names[] = {"build", "refit", "collide", "accuracy"};
    return names[static_cast<std::size_t>(operation)];
}

/// A builder and its options, as chosen on the command line or in an experiment. Owns its strings.
struct BuilderChoice {
    std::string name;
    std::string order = "morton30";
    GridOver grid = GridOver::object;
    unsigned group_size = 0;
    unsigned items = 0;
    bool sorted_leaves = false;
    std::string boxes = "f32";

    bool operator==(const BuilderChoice&) const = default;
    BuildOptions options() const
    {
        return {.order = order,
                .grid = grid,
                .group_size = group_size,
                .items = items,
                .sorted_leaves = sorted_leaves,
                .boxes = boxes};
    }
};

/// Throws BadUsage if there is no such builder or box format, or if the builder or its leaf placement does not allow the format.
void check_boxes(const BuilderChoice& choice);

/// Throws BadUsage if there is no such builder or it does not support the boxes; Unavailable if this binary lacks it.
std::unique_ptr<Builder> make_builder(const BuilderChoice& choice, Programs& programs);

}  // namespace bvhbench
