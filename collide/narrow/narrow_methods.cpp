// SPDX-License-Identifier: MIT
#include "collide/narrow/narrow_methods.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/error.h"
#include "geometry/names.h"

namespace bvhbench {
namespace {

constexpr NarrowMethod of_distance(std::string_view name, std::string_view summary,
                                   unsigned real_bits, unsigned test)
{
    return {name, summary, false, 0, real_bits, 0, test};
}

// To add a rounded method: add a line here and its kernel code to rounded.clh. Those without one are filters. In the order of NarrowOf.
constexpr NarrowMethod catalog[] = {
    {"filter-f64+exact", "floats, then doubles with error bounds, then exact sums: no error", true},
    {"filter-f64", "floats, then doubles with error bounds: none missed, false where in doubt",
     false, 0, 64},
    {"filter-f32", "planes in floats with error bounds: none missed, false where in doubt", false,
     0, 32},
    {"guigue-f64", "orientations in doubles, as computed", false, 2, 64},
    {"guigue-f32", "orientations in floats, as computed", false, 2, 32},
    {"moller-f32", "intervals in floats, heights below 1e-6 taken for 0", false, 1, 32},
    {"sat-f32", "projections onto 17 axes in floats, as computed", false, 3, 32},
    {"ccd-1e-2", "swept: none missed, false ones within 1e-2 of the scene's size", false, 0, 32,
     1e-2f},
    {"ccd-1e-4", "swept: none missed, false ones within 1e-4 of the scene's size", false, 0, 32,
     1e-4f},
    {"ccd-f64-1e-4", "swept, in doubles: none missed, false ones within 1e-4 of the scene's size",
     false, 0, 64, 1e-4f},
    {"ccd-1e-6", "swept: none missed, false ones within 1e-6 of the scene's size", false, 0, 32,
     1e-6f},
    {"ccd-f64-1e-6", "swept, in doubles: none missed, false ones within 1e-6 of the scene's size",
     false, 0, 64, 1e-6f},
    of_distance("within-f64", "distances: in doubles, as computed", 64, WITHIN_COMPUTED),
    of_distance("within-f32", "distances: in floats, as computed", 32, WITHIN_COMPUTED),
    of_distance("within-capsules", "distances: between capsules around the triangles, none missed",
                32, WITHIN_CAPSULES),
    of_distance("within-spheres", "distances: between spheres around the triangles, none missed",
                32, WITHIN_SPHERES),
    of_distance("within-rounded-boxes", "distances: between the triangles' boxes, none missed", 32,
                WITHIN_ROUNDED_BOXES),
    of_distance("within-boxes", "distances: padded boxes that overlap, none missed", 32,
                WITHIN_BOXES),
};

}  // namespace

std::span<const NarrowMethod> narrow_methods() { return catalog; }

std::span<const NarrowMethod> narrow_methods(NarrowOf question)
{
    return std::ranges::equal_range(catalog, question, {}, &NarrowMethod::of);
}

const NarrowMethod& find_narrow_method(std::string_view name)
{
    if (name == "exact")
        return *std::ranges::find_if(catalog, &NarrowMethod::is_exact);
    return find_called(catalog, name, "narrow phase", "exact");
}

void check_narrow(std::string_view name, bool keep_adjacent)
{
    if (name == "none")
        return;
    const NarrowMethod& method = find_narrow_method(name);
    if (method.rounded_test != 0 && keep_adjacent)
        throw BadUsage("--narrow " + std::string(name) +
                       " cannot tell what triangles that share a corner have beyond it: it needs "
                       "--adjacent drop");
}

void check_separation(double separation)
{
    if (!(separation >= 0 && std::isfinite(separation)))
        throw BadUsage("a separation is a finite number that is not negative");
}

void check_separation(std::string_view narrow, bool is_swept)
{
    if (!is_swept)
        throw BadUsage("'separation' is about the way between two frames: it needs 'swept'");
    if (narrow == "none")
        throw BadUsage("'separation' is about contacts: it needs a narrow phase" +
                       there_are("", names_of(narrow_methods(NarrowOf::step))));
}

void check_narrow_of(std::string_view name, NarrowOf question)
{
    if (name == "none")
        return;
    const NarrowMethod& method = find_narrow_method(name);
    if (method.of() == question || (method.is_exact && question == NarrowOf::distance))
        return;
    const std::string quoted = "'" + std::string(name) + "'";
    const std::string others = there_are(name, names_of(narrow_methods(question)));
    if (question == NarrowOf::step)
        throw BadUsage("swept boxes are of the way between two frames, and the narrow phase " +
                       quoted + " looks at one moment" + others);
    if (question == NarrowOf::distance)
        throw BadUsage("'within' is about distances, and the narrow phase " + quoted + " is not" +
                       others);
    throw BadUsage("the narrow phase " + quoted +
                   (method.of() == NarrowOf::step
                        ? " looks at the way between two frames: it needs swept boxes"
                        : " is about a distance: it needs 'within'"));
}

}  // namespace bvhbench
