// SPDX-License-Identifier: MIT
//
// What cells are called in tables: builder, collider, options that are not the usual ones.
#include "harness/report.h"

namespace bvhbench {

std::string pipeline_text(const Cell& cell)
{
    if (cell.operation == Operation::accuracy)
        return cell.accuracy.axis + ", " + cell.accuracy.method;
    if (cell.operation == Operation::collide)
        return (cell.swept.pairs.empty() ? "" : cell.swept.pairs + " by ") +
               variant_text(cell.collider) +
               (cell.builder.name == "none" ? "" : " over " + variant_text(cell.builder));
    return variant_text(cell.builder) + (cell.operation == Operation::refit ? ", refit" : "");
}

std::string variant_text(const BuilderChoice& builder)
{
    const BuilderChoice usual;
    std::string text = builder.name;
    if (builder.order != usual.order)
        text += ", " + builder.order;
    if (builder.grid != usual.grid)
        text += ", grid over the scene";
    if (builder.group_size != usual.group_size)
        text += ", groups of " + std::to_string(builder.group_size);
    if (builder.items != usual.items)
        text += ", " + std::to_string(builder.items) + " items";
    if (builder.boxes != usual.boxes)  // which says that leaves are sorted
        text += ", " + builder.boxes + " boxes";
    else if (builder.sorted_leaves)
        text += ", sorted leaves";
    return text;
}

std::string variant_text(const ColliderChoice& collider)
{
    const ColliderChoice usual;
    std::string text = collider.name;
    if (collider.among != usual.among)
        text += ", " + std::string(among_name(collider.among)) + " objects";
    if (!collider.keep_adjacent)
        text += ", adjacent dropped";
    if (collider.narrow != usual.narrow)
        text += ", contacts " + collider.narrow;
    if (collider.rules_off != 0)
        text += ", without " + skip_rules_text(collider.rules_off);
    if (collider.jump != usual.jump)
        text += ", jump " + std::to_string(collider.jump);
    if (collider.start_level != usual.start_level)
        text += ", from level " + std::to_string(collider.start_level);
    if (collider.group_size != usual.group_size)
        text += ", groups of " + std::to_string(collider.group_size);
    return text;
}

}  // namespace bvhbench
