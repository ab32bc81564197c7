// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>

#include "collide/oracles/box_pairs.h"
#include "collide/oracles/exact_reference.h"
#include "collide/pairs.h"
#include "harness/stress/judge.h"
#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

/// Numbers of triangles in a scene, by the object that they are in or are to be in.
using ByObject = std::vector<std::vector<uint>>;

ByObject triangles_of(const StressScene& scene)
{
    ByObject objects;
    for (const FaceRange& range : scene.objects) {
        objects.emplace_back(range.count);
        std::iota(objects.back().begin(), objects.back().end(), range.first);
    }
    return objects;
}

/// Returns a scene of these triangles, in this order.
Rearranged rearranged(const StressScene& scene, const ByObject& objects)
{
    Rearranged result{{{scene.mesh.points, {}}, {}}, {}};
    for (const std::vector<uint>& ids : objects) {
        result.scene.objects.push_back(
            {static_cast<uint>(result.original.size()), static_cast<uint>(ids.size())});
        result.original.insert(result.original.end(), ids.begin(), ids.end());
    }
    for (const uint id : result.original)
        result.scene.mesh.faces.push_back(scene.mesh.faces[id]);
    return result;
}

/// Returns the scene with the triangles of each object shuffled and the objects in their order.
Rearranged shuffled(const StressScene& scene, std::uint64_t seed)
{
    ByObject objects = triangles_of(scene);
    Random random(seed);
    for (std::vector<uint>& ids : objects)
        for (std::size_t k = ids.size(); k > 1; --k)
            std::swap(ids[k - 1], ids[random.bits() % k]);
    return rearranged(scene, objects);
}

/// Returns the scene with its objects in reverse order.
Rearranged swapped(const StressScene& scene)
{
    ByObject objects = triangles_of(scene);
    std::ranges::reverse(objects);
    return rearranged(scene, objects);
}

bool is_finite(const Mesh& mesh, const Face& face)
{
    for (const uint corner : {face.a, face.b, face.c})
        for (const float x : {mesh.points[corner].x, mesh.points[corner].y, mesh.points[corner].z})
            if (!std::isfinite(x))
                return false;
    return true;
}

/// Returns the scene with every coordinate changed in double, or nothing if a result is not a float.
template <class Change>
std::optional<StressScene> changed_exactly(const StressScene& scene, const Change& change)
{
    bool is_exact = true;
    StressScene result = changed(scene, [&](double x) {
        const double wanted = change(x);
        is_exact = is_exact && static_cast<double>(static_cast<float>(wanted)) == wanted;
        return wanted;
    });
    return is_exact ? std::optional(std::move(result)) : std::nullopt;
}

PairList pairs_of(const StressScene& scene)
{
    return touching_pairs(scene.mesh.points, scene.mesh.faces, true);
}

FoundPairs expected_over(const StressScene& scene, PairList pairs)
{
    FoundPairs expected;
    expected.pairs = std::move(pairs);
    if (has_exact_reference)
        expected.contacts =
            intersecting_pairs(scene.mesh.points, scene.mesh.faces, expected.pairs->pairs(), true);
    return expected;
}

}  // namespace

std::optional<StressScene> scaled(const StressScene& scene, std::uint64_t seed)
{
    const int first = 1 + static_cast<int>(Random(seed).bits() % 30);
    for (const int exponent : {first, -first, 7, -7, 1, -1})
        if (auto result = changed_exactly(scene, [&](double x) { return std::ldexp(x, exponent); }))
            return result;
    return {};
}

std::optional<std::pair<StressScene, StressScene>> translated(const StressScene& scene)
{
    double largest = 0;
    for (const Point& p : scene.mesh.points)
        for (const float x : {p.x, p.y, p.z})
            largest = std::max(largest, std::abs(static_cast<double>(x)));
    if (largest == 0 || largest > 0x1p120)
        return {};
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double by = std::ldexp(1.0, exponent + 3);         // sums are below 2 * by,
    const double grid = std::ldexp(1.0, exponent + 4 - 24);  // where adjacent floats differ by this
    if (grid < 0x1p-149)
        return {};
    auto snapped =
        changed_exactly(scene, [grid](double x) { return std::nearbyint(x / grid) * grid; });
    std::optional<StressScene> moved;
    if (snapped)
        moved = changed_exactly(*snapped, [by](double x) { return x + by; });
    if (!moved)
        return {};
    return std::pair(std::move(*snapped), std::move(*moved));
}

Rearranged finite_part(const StressScene& scene)
{
    ByObject objects = triangles_of(scene);
    for (std::vector<uint>& ids : objects)
        std::erase_if(ids, [&](uint id) { return !is_finite(scene.mesh, scene.mesh.faces[id]); });
    return rearranged(scene, objects);
}

StressQuestion question_of(StressScene scene, std::uint64_t seed)
{
    FoundPairs expected = expected_over(scene, pairs_of(scene));
    std::vector<StressVariant> variants;
    variants.push_back({Invariant::agree, "shuffled", shuffled(scene, seed), expected});
    if (scene.objects.size() > 1)
        variants.push_back({Invariant::agree, "objects swapped", swapped(scene), expected});
    if (auto moved = scaled(scene, seed))
        variants.push_back({Invariant::moved, "scaled", {std::move(*moved), {}}, expected});
    // Snapping an outlier scene to the translation's grid may leave almost one point, which is a different scene.
    const std::size_t most = 100 * (expected.pairs->size() + scene.mesh.faces.size());
    if (auto translation = translated(scene)) {
        auto& [snapped, moved] = *translation;
        if (PairList pairs = pairs_of(snapped); pairs.size() <= most)
            variants.push_back({Invariant::moved,
                                "translated",
                                std::move(moved),
                                {},
                                expected_over(snapped, std::move(pairs))});
    }
    return {std::move(scene), std::move(expected), std::move(variants)};
}

StressQuestion without_adjacent(StressQuestion question)
{
    const auto leave_out = [&faces = question.scene.mesh.faces](FoundPairs& found) {
        for (auto* list : {&found.pairs, &found.contacts})
            if (*list)
                *list = selected(**list, {faces, {}}, Relation::apart);
    };
    leave_out(question.expected);
    for (StressVariant& variant : question.variants)
        leave_out(variant.expected);
    return question;
}

}  // namespace bvhbench
