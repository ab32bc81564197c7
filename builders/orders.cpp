// SPDX-License-Identifier: MIT
#include "builders/orders.h"

#include "geometry/hilbert.h"
#include "geometry/names.h"

namespace bvhbench {
namespace {

constexpr OrderEntry catalog[] = {
    {"morton30", "Morton code of the box centre, 10 bits an axis", 30, false},
    {"morton48", "Morton code of the box centre, 16 bits an axis", 48, false},
    {"morton63", "Morton code of the box centre, 21 bits an axis", 63, false},
    {"hilbert30", "Hilbert code of the box centre, 10 bits an axis", 30, true},
    {"hilbert48", "Hilbert code of the box centre, 16 bits an axis", 48, true},
    {"hilbert63", "Hilbert code of the box centre, 21 bits an axis", 63, true},
    {"morton30-axis", "as morton30, cells stretched to the scene's box", 30, false, true},
    {"morton48-axis", "as morton48, cells stretched to the scene's box", 48, false, true},
    {"morton63-axis", "as morton63, cells stretched to the scene's box", 63, false, true},
    {"hilbert30-axis", "as hilbert30, cells stretched to the scene's box", 30, true, true},
    {"hilbert48-axis", "as hilbert48, cells stretched to the scene's box", 48, true, true},
    {"hilbert63-axis", "as hilbert63, cells stretched to the scene's box", 63, true, true},
    {"hilbert30+kd1024", "as hilbert30, then exact medians within blocks of 1,024 leaves", 30, true,
     false, Medians::in_blocks},
    {"kd", "exact medians at every level of the tree", 0, false, false, Medians::everywhere},
    {"morton24", "Morton code of the box centre, 8 bits an axis", 24, false},
    {"hilbert24", "Hilbert code of the box centre, 8 bits an axis", 24, true},
};

}  // namespace

ulong OrderEntry::code(Aabb box, Bounds bounds) const
{
    const uint axis_bits = code_bits / 3;
    const auto cells = static_cast<float>(1u << axis_bits);
    GridCell cell =
        is_stretched ? stretched_cell(box, bounds, cells) : cubic_cell(box, bounds, cells);
    if (is_hilbert)
        cell = hilbert_cell(cell, axis_bits);
    return morton_63(cell);
}

std::span<const OrderEntry> order_catalog() { return catalog; }

const OrderEntry& find_order(std::string_view name) { return find_called(catalog, name, "order"); }

}  // namespace bvhbench
