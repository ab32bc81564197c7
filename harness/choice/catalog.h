// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "builders/builder.h"

namespace bvhbench {

/// A line of `list builders`.
struct BuilderEntry {
    std::string_view name;     ///< the key on the command line, in result files and legends
    std::string_view summary;  ///< one line
    /// The builder whose tree it must leave, bit for bit; empty if it is held to the promises only.
    std::string_view oracle;
    MakeBuilder make;              ///< nullptr when this binary was built without it
    std::string_view absent = {};  ///< then: why, as in "built without Embree"
    /// Set if the builder may throw Unavailable for some meshes, for the reason given here. It then does so
    /// instead of leaving a wrong tree, and never for an ordinary mesh.
    std::string_view may_refuse = {};
    bool is_library = false;     ///< the work is done by somebody else's code
    bool takes_formats = false;  ///< whether its tree may keep boxes in any of box_formats()
};

/// Every builder, in the order tables list them.
std::span<const BuilderEntry> builder_catalog();

/// By name. Throws BadUsage with the known names when there is none.
const BuilderEntry& find_builder(std::string_view name);

/// What is timed: a whole build, new boxes for a tree that stands, a build and a query of its tree, or what an axis of
/// accuracy counts the errors of.
enum class Operation { build, refit, collide, accuracy };

/// The word for it in experiments and result files.
constexpr std::string_view operation_name(Operation operation)
{
    constexpr std::string_view names[] = {"build", "refit", "collide", "accuracy"};
    return names[static_cast<std::size_t>(operation)];
}

/// Which builder, set up how: what the command line and experiment files choose. Owns its words.
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

/// Throws BadUsage if nothing is called so, or if the builder or its leaves do not allow those boxes.
void check_boxes(const BuilderChoice& choice);

/// Throws BadUsage when no builder is called so or it has not such boxes, Unavailable when this binary was built without it.
std::unique_ptr<Builder> make_builder(const BuilderChoice& choice, Programs& programs);

}  // namespace bvhbench
