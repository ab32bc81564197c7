// SPDX-License-Identifier: MIT
#include "builders/orders.h"

#include <string>

#include "geometry/error.h"
#include "geometry/morton.h"

namespace bvhbench {
namespace {

ulong morton_30_code(Aabb box, Aabb centres) { return morton_30(box, centres); }
ulong morton_63_code(Aabb box, Aabb centres) { return morton_63(box, centres); }

// To add an order, add its line here and its kernel to stages/codes.cl.
constexpr OrderEntry catalog[] = {
    {"morton30", "Morton code of the box centre, 10 bits an axis", 30, "morton30", morton_30_code},
    {"morton63", "Morton code of the box centre, 21 bits an axis", 63, "morton63", morton_63_code},
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
