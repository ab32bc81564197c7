// SPDX-License-Identifier: MIT
#include "harness/measure/one_tree.h"

#include <algorithm>
#include <limits>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// From how many objects on, of at most how many triangles on average, one tree is sooner there than a tree each (docs/frames.md).
constexpr std::size_t many_objects = 512, small_on_cpu = 16, small_elsewhere = 128;

/// Returns true if triangles of two objects have a vertex in common.
bool share_vertices(const Input& input)
{
    constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> owners(input.points.size(), nobody);
    for (std::size_t object = 0; object < input.objects.size(); ++object)
        for (const Face& face :
             input.faces.subspan(input.objects[object].first, input.objects[object].count))
            for (const uint corner : {face.a, face.b, face.c}) {
                if (owners[corner] != nobody && owners[corner] != object)
                    return true;
                owners[corner] = object;
            }
    return false;
}

std::vector<Face> owners_of(const Input& input)
{
    std::vector<Face> owners;
    for (uint object = 0; object < input.objects.size(); ++object)
        owners.resize(owners.size() + input.objects[object].count, {object, object, object});
    return owners;
}

}  // namespace

OneTree::OneTree(Session& session, const ColliderChoice& asked, const Input& input)
    : question_(asked), built_(input)
{
    if (input.is_swept())
        throw BadUsage("with swept boxes 'trees' is object: vertices and faces get a tree each");
    if (asked.among == Among::within_objects)
        throw BadUsage(
            "one tree over the scene finds pairs of all objects: for pairs within objects 'trees' "
            "is object");
    if (!asked.filter.is_empty())
        throw BadUsage(
            "one tree over the scene does not tell its objects apart: with 'exclude' 'trees' is "
            "object");
    built_.objects = {{0, input.triangle_count()}};
    if (asked.among == Among::all)
        return;
    if (asked.first)
        throw BadUsage(
            "one tree over the scene does not tell its objects apart: with 'first' between objects "
            "'trees' is object");
    if (!asked.keep_adjacent && share_vertices(input))
        throw BadUsage(
            "objects of this scene share vertices, and one tree over the scene cannot drop pairs "
            "of two objects that share one: 'trees' is object, or 'adjacent' keep");
    question_.among = Among::all;
    question_.keep_adjacent = false;
    owners_ = owners_of(input);
    queried_ = upload_over(built_, session.device(), session.queue(), owners_);
}

TreeOver trees_over(const ColliderChoice& asked, const Input& input, bool on_cpu)
{
    const std::size_t small_object = on_cpu ? small_on_cpu : small_elsewhere;
    const std::size_t objects = input.objects.size();
    if (!asked.filter.is_empty() || objects < many_objects ||
        input.triangle_count() > small_object * objects)
        return TreeOver::object;
    const ColliderEntry& collider = find_collider(asked.name);
    const bool can_be =
        collider.needs_tree && collider.outside == nullptr && !input.is_swept() &&
        (asked.among == Among::all || (asked.among == Among::between_objects && !asked.first &&
                                       (asked.keep_adjacent || !share_vertices(input))));
    return can_be ? TreeOver::scene : TreeOver::object;
}

std::optional<OneTree> one_tree_for(Session& session, const ColliderChoice& asked,
                                    const Input& input)
{
    if (asked.trees != TreeOver::scene)
        return {};
    if (input.objects.size() == 1)
        throw BadUsage("the scene is one object, which has one tree: 'trees' is object");
    return std::optional<OneTree>(std::in_place, session, asked, input);
}

Motion motion_of_all(std::span<const Motion> motions)
{
    const bool is_still = std::ranges::count(motions, Motion::unchanged) == std::ssize(motions);
    return is_still ? Motion::unchanged : Motion::deforming;
}

}  // namespace bvhbench
