// SPDX-License-Identifier: MIT
#include "builders/orders.h"

#include <string>

#include "geometry/error.h"
#include "geometry/hilbert.h"

namespace bvhbench {
namespace {

using CellOf = Cell (*)(Aabb box, Bounds bounds, float cells);

template <CellOf cell, uint (*code)(Cell)>
ulong code_30(Aabb box, Bounds bounds)
{
    return code(cell(box, bounds, CELLS_30));
}

template <CellOf cell, ulong (*code)(Cell)>
ulong code_48(Aabb box, Bounds bounds)
{
    return code(cell(box, bounds, CELLS_48));
}

template <CellOf cell, ulong (*code)(Cell)>
ulong code_63(Aabb box, Bounds bounds)
{
    return code(cell(box, bounds, CELLS_63));
}

// To add an order, add its line here and its lines to stages/codes.cl and codes_chunks.cl.
constexpr OrderEntry catalog[] = {
    {"morton30", "Morton code of the box centre, 10 bits an axis", 30, "morton30",
     code_30<cubic_cell, morton_30>},
    {"morton48", "Morton code of the box centre, 16 bits an axis", 48, "morton48",
     code_48<cubic_cell, morton_48>},
    {"morton63", "Morton code of the box centre, 21 bits an axis", 63, "morton63",
     code_63<cubic_cell, morton_63>},
    {"hilbert30", "Hilbert code of the box centre, 10 bits an axis", 30, "hilbert30",
     code_30<cubic_cell, hilbert_30>},
    {"hilbert48", "Hilbert code of the box centre, 16 bits an axis", 48, "hilbert48",
     code_48<cubic_cell, hilbert_48>},
    {"hilbert63", "Hilbert code of the box centre, 21 bits an axis", 63, "hilbert63",
     code_63<cubic_cell, hilbert_63>},
    {"morton30-axis", "as morton30, cells stretched to the scene's box", 30, "morton30_axis",
     code_30<stretched_cell, morton_30>},
    {"morton48-axis", "as morton48, cells stretched to the scene's box", 48, "morton48_axis",
     code_48<stretched_cell, morton_48>},
    {"morton63-axis", "as morton63, cells stretched to the scene's box", 63, "morton63_axis",
     code_63<stretched_cell, morton_63>},
    {"hilbert30-axis", "as hilbert30, cells stretched to the scene's box", 30, "hilbert30_axis",
     code_30<stretched_cell, hilbert_30>},
    {"hilbert48-axis", "as hilbert48, cells stretched to the scene's box", 48, "hilbert48_axis",
     code_48<stretched_cell, hilbert_48>},
    {"hilbert63-axis", "as hilbert63, cells stretched to the scene's box", 63, "hilbert63_axis",
     code_63<stretched_cell, hilbert_63>},
    {"hilbert30+kd1024", "as hilbert30, then exact medians within blocks of 1,024 leaves", 30,
     "hilbert30", code_30<cubic_cell, hilbert_30>, Medians::in_blocks},
    {"kd", "exact medians at every level of the tree", 0, nullptr, nullptr, Medians::everywhere},
};

}  // namespace

std::span<const OrderEntry> order_catalog() { return catalog; }

const OrderEntry& find_order(std::string_view name)
{
    std::string known;
    for (const OrderEntry& entry : catalog) {
        if (entry.name == name)
            return entry;
        known += (known.empty() ? " " : ", ") + std::string(entry.name);
    }
    throw BadUsage("no order is called '" + std::string(name) + "'; there are:" + known);
}

}  // namespace bvhbench
