// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>

#include "collide/oracles/exact_reference.h"
#include "collide/oracles/sweep.h"
#include "collide/pairs.h"
#include "harness/stress/judge.h"
#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

/// Returns the scene with its triangles in the order of `ids`.
StressVariant reordered(const StressScene& scene, std::string_view name, std::vector<uint> ids,
                        std::vector<FaceRange> objects)
{
    StressVariant variant{Invariant::agree, name, {{scene.mesh.points, {}}, std::move(objects)}};
    for (const uint id : ids)
        variant.scene.mesh.faces.push_back(scene.mesh.faces[id]);
    variant.original = std::move(ids);
    return variant;
}

/// Returns the scene with the triangles of each object shuffled and the objects in their order.
StressVariant shuffled(const StressScene& scene, std::uint64_t seed)
{
    std::vector<uint> ids(scene.mesh.faces.size());
    std::iota(ids.begin(), ids.end(), 0u);
    Random random(seed);
    for (const FaceRange& range : scene.objects)
        for (uint k = range.count; k > 1; --k)
            std::swap(ids[range.first + k - 1],
                      ids[range.first + static_cast<uint>(random.bits() % k)]);
    return reordered(scene, "shuffled", std::move(ids), scene.objects);
}

/// Returns the scene with its objects in reverse order.
StressVariant swapped(const StressScene& scene)
{
    std::vector<uint> ids;
    std::vector<FaceRange> objects;
    for (std::size_t k = scene.objects.size(); k-- > 0;) {
        const FaceRange range = scene.objects[k];
        objects.push_back({static_cast<uint>(ids.size()), range.count});
        for (uint i = 0; i < range.count; ++i)
            ids.push_back(range.first + i);
    }
    return reordered(scene, "objects swapped", std::move(ids), std::move(objects));
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
            intersecting_pairs(scene.mesh.points, scene.mesh.faces, *expected.pairs, true);
    return expected;
}

}  // namespace

std::optional<StressVariant> scaled(const StressScene& scene, std::uint64_t seed)
{
    const int first = 1 + static_cast<int>(Random(seed).bits() % 30);
    for (const int exponent : {first, -first, 7, -7, 1, -1})
        if (auto result = changed_exactly(scene, [&](double x) { return std::ldexp(x, exponent); }))
            return StressVariant{Invariant::moved, "scaled", std::move(*result)};
    return {};
}

std::optional<Translation> translated(const StressScene& scene)
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
    if (!snapped)
        return {};
    auto moved = changed_exactly(*snapped, [by](double x) { return x + by; });
    if (!moved)
        return {};
    return Translation{std::move(*snapped), {Invariant::moved, "translated", std::move(*moved)}};
}

PairList in_original_numbers(const PairList& pairs, const StressVariant& variant)
{
    if (variant.original.empty())
        return pairs;
    std::vector<Pair> numbered;
    numbered.reserve(pairs.size());
    for (const Pair pair : pairs.pairs())
        numbered.push_back({variant.original[pair.a], variant.original[pair.b]});
    return PairList(std::move(numbered));
}

StressQuestion question_of(StressScene scene, std::uint64_t seed)
{
    StressQuestion question{std::move(scene), {}, {}};
    question.expected = expected_over(question.scene, pairs_of(question.scene));
    const auto add = [&](StressVariant variant) {
        question.variants.push_back({std::move(variant), question.expected});
    };
    add(shuffled(question.scene, seed));
    if (question.scene.objects.size() > 1)
        add(swapped(question.scene));
    if (auto variant = scaled(question.scene, seed))
        add(std::move(*variant));
    // Snapping an outlier scene to the translation's grid may leave almost one point, which is a different scene.
    const std::size_t most =
        100 * (question.expected.pairs->size() + question.scene.mesh.faces.size());
    if (auto translation = translated(question.scene))
        if (PairList pairs = pairs_of(translation->snapped); pairs.size() <= most)
            question.variants.push_back({std::move(translation->moved),
                                         expected_over(translation->snapped, std::move(pairs))});
    return question;
}

StressQuestion without_adjacent(const StressQuestion& question)
{
    StressQuestion apart = question;
    const auto leave_out = [&faces = question.scene.mesh.faces](FoundPairs& found) {
        for (auto* list : {&found.pairs, &found.contacts})
            if (*list)
                *list = selected(**list, {faces, {}}, Relation::apart);
    };
    leave_out(apart.expected);
    for (StressQuestion::Variant& variant : apart.variants)
        leave_out(variant.expected);
    return apart;
}

}  // namespace bvhbench
