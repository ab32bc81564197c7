// SPDX-License-Identifier: MIT
#include "harness/stress/variants.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

std::vector<uint> as_they_are(const StressScene& scene)
{
    std::vector<uint> ids(scene.mesh.faces.size());
    std::iota(ids.begin(), ids.end(), 0u);
    return ids;
}

/// The same with triangles in the order of `ids`.
StressScene reordered(const StressScene& scene, const std::vector<uint>& ids)
{
    StressScene result{{scene.mesh.points, {}}, scene.objects};
    for (const uint id : ids)
        result.mesh.faces.push_back(scene.mesh.faces[id]);
    return result;
}

double largest_coordinate(const Mesh& mesh)
{
    double largest = 0;
    for (const Point& p : mesh.points)
        for (const float x : {p.x, p.y, p.z})
            largest = std::max(largest, std::abs(static_cast<double>(x)));
    return largest;
}

/// `scene` with every coordinate changed in double, if all results are floats.
template <class Change>
std::optional<StressScene> changed_exactly(const StressScene& scene, const Change& change)
{
    StressScene result = scene;
    for (Point& p : result.mesh.points)
        for (float Point::*c : {&Point::x, &Point::y, &Point::z}) {
            const double wanted = change(static_cast<double>(p.*c));
            p.*c = static_cast<float>(wanted);
            if (static_cast<double>(p.*c) != wanted)
                return {};
        }
    return result;
}

}  // namespace

StressVariant shuffled(const StressScene& scene, std::uint64_t seed)
{
    std::vector<uint> ids = as_they_are(scene);
    Random random(seed);
    for (const FaceRange& range : scene.objects)
        for (uint k = range.count; k > 1; --k)
            std::swap(ids[range.first + k - 1],
                      ids[range.first + static_cast<uint>(random.bits() % k)]);
    return {Invariant::agree, "shuffled", reordered(scene, ids), std::move(ids)};
}

std::optional<StressVariant> swapped(const StressScene& scene)
{
    if (scene.objects.size() < 2)
        return {};
    std::vector<uint> ids;
    std::vector<FaceRange> objects;
    for (std::size_t k = scene.objects.size(); k-- > 0;) {
        const FaceRange range = scene.objects[k];
        objects.push_back({static_cast<uint>(ids.size()), range.count});
        for (uint i = 0; i < range.count; ++i)
            ids.push_back(range.first + i);
    }
    StressVariant variant{Invariant::agree, "objects swapped", reordered(scene, ids), ids};
    variant.scene.objects = std::move(objects);
    return variant;
}

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
    const double largest = largest_coordinate(scene.mesh);
    if (largest == 0 || largest > 0x1p120)
        return {};
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double by = std::ldexp(1.0, exponent + 3);         // sums are below twice that,
    const double grid = std::ldexp(1.0, exponent + 4 - 24);  // where floats are so far apart
    if (grid < 0x1p-149)
        return {};
    const auto snap = [grid](double x) { return std::nearbyint(x / grid) * grid; };
    auto snapped = changed_exactly(scene, snap);
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

}  // namespace bvhbench
