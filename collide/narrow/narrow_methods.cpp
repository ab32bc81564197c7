// SPDX-License-Identifier: MIT
#include "collide/narrow/narrow_methods.h"

#include <string>

#include "geometry/error.h"

namespace bvhbench {
namespace {

// To add a narrow phase that rounds, add its line here and its text to rounded_verdict.clh.
constexpr NarrowMethod catalog[] = {
    {"filter-f64+exact", "floats, then doubles with error bounds, then exact sums: no error", true},
    {"guigue-f64", "orientations in doubles, as computed", false, 2, 64},
    {"guigue-f32", "orientations in floats, as computed", false, 2, 32},
    {"moller-f32", "intervals in floats, heights below 1e-6 taken for 0", false, 1, 32},
};

}  // namespace

std::span<const NarrowMethod> narrow_methods() { return catalog; }

const NarrowMethod& find_narrow_method(std::string_view name)
{
    std::string known;
    for (const NarrowMethod& method : catalog) {
        if (method.name == name || (method.is_exact && name == "exact"))
            return method;
        known += ", " + std::string(method.name);
    }
    throw BadUsage("no narrow phase is called '" + std::string(name) + "'; there are: exact" +
                   known);
}

void check_narrow(std::string_view name, bool keep_adjacent)
{
    if (name != "none" && !find_narrow_method(name).is_exact && keep_adjacent)
        throw BadUsage("--narrow " + std::string(name) +
                       " cannot tell what triangles that share a corner have beyond it: it needs "
                       "--adjacent drop");
}

}  // namespace bvhbench
