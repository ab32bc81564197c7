// SPDX-License-Identifier: MIT
#include "scenes/facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "geometry/cores.h"
#include "geometry/orient.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

/// Notices are given where a float's step is more than this share of the median edge, and for more pairs a triangle than this.
constexpr double coarse = 1.0 / 256, many_pairs = 1000;

/// The most box tests that an estimate of pairs may take, unless the least number of samples needs more.
constexpr std::size_t most_tests = 200'000'000, least_samples = 16;

using Corners = std::array<uint, 3>;

std::vector<bool> used_vertices(const Scene& scene)
{
    std::vector<bool> used(scene.frames.front().size());
    for (const Face& face : scene.faces)
        used[face.a] = used[face.b] = used[face.c] = true;
    return used;
}

/// Returns for each vertex the first used one that has its position in every frame; unused vertices stay themselves.
std::vector<uint> first_of_position(const Scene& scene)
{
    const std::vector<bool> used = used_vertices(scene);
    std::vector<uint> first(used.size()), order;
    std::iota(first.begin(), first.end(), 0u);
    std::ranges::copy_if(first, std::back_inserter(order), [&](uint k) { return used[k]; });
    const auto compare = [&](uint a, uint b) {
        for (const std::vector<Point>& points : scene.frames) {
            const Point &p = points[a], &q = points[b];
            const std::array at_p = {p.x, p.y, p.z}, at_q = {q.x, q.y, q.z};
            if (at_p != at_q)
                return at_p < at_q ? -1 : 1;
        }
        return 0;
    };
    std::ranges::sort(order, [&](uint a, uint b) {
        const int sign = compare(a, b);
        return sign != 0 ? sign < 0 : a < b;
    });
    for (std::size_t k = 1; k < order.size(); ++k)
        if (compare(order[k - 1], order[k]) == 0)
            first[order[k]] = first[order[k - 1]];
    return first;
}

/// Returns how many triangles have the corners of an earlier one, in any order, with vertices replaced by `as`.
std::uint64_t repeated(const Scene& scene, const std::vector<uint>& as)
{
    std::vector<Corners> all;
    all.reserve(scene.faces.size());
    for (const Face& face : scene.faces) {
        Corners corners = {as[face.a], as[face.b], as[face.c]};
        std::ranges::sort(corners);
        all.push_back(corners);
    }
    std::ranges::sort(all);
    std::uint64_t count = 0;
    for (std::size_t k = 1; k < all.size(); ++k)
        count += all[k] == all[k - 1] ? 1 : 0;
    return count;
}

double distance(const Point& a, const Point& b)
{
    return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

void count_edges(const Scene& scene, MeshFacts& facts)
{
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * scene.faces.size());
    for (const Face& face : scene.faces)
        for (const auto& [u, v] :
             {std::pair(face.a, face.b), std::pair(face.b, face.c), std::pair(face.c, face.a)})
            if (u != v)
                edges.push_back(std::uint64_t{std::min(u, v)} << 32 | std::max(u, v));
    std::ranges::sort(edges);
    const std::vector<Point>& points = scene.frames.front();
    std::vector<double> lengths;
    for (std::size_t k = 0, end = 0; k < edges.size(); k = end) {
        while (end < edges.size() && edges[end] == edges[k])
            ++end;
        ++(end - k == 1   ? facts.open_edges
           : end - k == 2 ? facts.shared_edges
                          : facts.nonmanifold_edges);
        lengths.push_back(distance(points[edges[k] >> 32], points[edges[k] & 0xffffffffu]));
    }
    if (lengths.empty())
        return;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    facts.median_edge = *middle;
    facts.longest_edge = *std::max_element(middle, lengths.end());
}

Aabb box_of(const Scene& scene, std::size_t face)
{
    const std::vector<Point>& points = scene.frames.front();
    const Face& corners = scene.faces[face];
    return triangle_box(points[corners.a], points[corners.b], points[corners.c]);
}

/// Estimates the number of pairs by those of evenly spread triangles.
double estimated_pairs(const Scene& scene, std::size_t samples)
{
    const std::size_t faces = scene.faces.size();
    samples = std::min({samples, faces, std::max(least_samples, most_tests / faces)});
    std::vector<std::uint64_t> found(samples);
    on_all_cores(samples, [&](std::size_t k) {
        const std::size_t sample = k * faces / samples;
        const Aabb box = box_of(scene, sample);
        for (std::size_t other = 0; other < faces; ++other)
            if (!share_a_vertex(scene.faces[sample], scene.faces[other]) &&
                overlap(box, box_of(scene, other)))
                ++found[k];
    });
    const auto sum = std::accumulate(found.begin(), found.end(), std::uint64_t{0});
    return static_cast<double>(sum) * static_cast<double>(faces) / static_cast<double>(2 * samples);
}

std::string counted(std::uint64_t count, const char* one, const char* many)
{
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

}  // namespace

MeshFacts mesh_facts(const Scene& scene, std::size_t samples)
{
    MeshFacts facts;
    const std::vector<Point>& points = scene.frames.front();
    const std::vector<bool> used = used_vertices(scene);
    facts.unused_vertices = static_cast<std::uint64_t>(std::ranges::count(used, false));
    std::vector<uint> same(points.size());
    std::iota(same.begin(), same.end(), 0u);
    facts.duplicate = repeated(scene, same);
    same = first_of_position(scene);
    for (uint k = 0; k < same.size(); ++k)
        facts.weldable_vertices += same[k] != k ? 1 : 0;
    facts.equal = facts.weldable_vertices == 0 ? 0 : repeated(scene, same) - facts.duplicate;
    count_edges(scene, facts);
    float largest = 0;
    facts.low.fill(std::numeric_limits<float>::infinity());
    facts.high.fill(-std::numeric_limits<float>::infinity());
    for (const Face& face : scene.faces) {
        const Point &a = points[face.a], &b = points[face.b], &c = points[face.c];
        if (orient2d(a, b, c, 0) == 0 && orient2d(a, b, c, 1) == 0 && orient2d(a, b, c, 2) == 0)
            ++facts.without_area;
        for (const Point& p : {a, b, c})
            for (uint axis = 0; axis < 3; ++axis) {
                const float x = coordinate(p, axis);
                facts.low[axis] = std::min(facts.low[axis], x);
                facts.high[axis] = std::max(facts.high[axis], x);
                largest = std::max(largest, std::fabs(x));
            }
    }
    facts.float_step = double{largest} - double{std::nextafter(largest, 0.0f)};
    facts.expected_pairs = estimated_pairs(scene, samples);
    return facts;
}

std::string surprises(const Scene& scene)
{
    std::vector<std::string> all = scene.reading.surprises;
    if (!scene.facts)
        return "";
    const MeshFacts& facts = *scene.facts;
    const Reading& reading = scene.reading;
    const std::uint64_t triangles = scene.faces.size();
    const auto of_triangles = [&](std::uint64_t count, const std::string& what) {
        if (count > 0)
            all.push_back(std::to_string(count) + " of " +
                          counted(triangles, "triangle ", "triangles ") + what);
    };
    if (reading.polygons_concave > 0)
        all.push_back(std::to_string(reading.polygons_concave) + " of " +
                      counted(reading.polygons_cut, "polygon", "polygons") +
                      " of more than three corners " +
                      (reading.polygons_concave == 1 ? "is" : "are") + " not convex, cut by ears");
    if (reading.polygons_crossing > 0)
        all.push_back(counted(reading.polygons_crossing, "polygon crosses itself",
                              "polygons cross themselves") +
                      ", so its triangles may cover more than it does");
    if (facts.shared_edges == 0 && facts.weldable_vertices > 0)
        all.push_back("no two triangles share an edge, and --weld would join " +
                      std::to_string(facts.weldable_vertices) + " of " +
                      counted(scene.frames.front().size(), "vertex", "vertices"));
    else if (facts.weldable_vertices > 0)
        all.push_back(counted(facts.weldable_vertices, "vertex has", "vertices have") +
                      " the position of another one, and --weld would join them");
    of_triangles(facts.without_area, facts.without_area == 1 ? "has no area" : "have no area");
    of_triangles(facts.duplicate + facts.equal,
                 facts.duplicate + facts.equal == 1 ? "equals another one" : "equal another one");
    char text[200];
    if (facts.float_step > coarse * facts.median_edge && facts.median_edge > 0) {
        std::snprintf(text, sizeof text,
                      "floats are %.2g apart at its largest coordinate, %.2g times its median edge",
                      facts.float_step, facts.float_step / facts.median_edge);
        all.emplace_back(text);
    }
    if (facts.expected_pairs > many_pairs * static_cast<double>(triangles)) {
        std::snprintf(text, sizeof text, "some %.1e pairs of boxes overlap", facts.expected_pairs);
        all.emplace_back(text);
    }
    std::string line;
    for (const std::string& one : all)
        line += (line.empty() ? "" : "; ") + one;
    return line;
}

Scene welded(Scene scene)
{
    for (Scene& later : scene.later)
        later = welded(std::move(later));
    std::vector<uint> place = first_of_position(scene);
    uint kept = 0;
    for (uint k = 0; k < place.size(); ++k) {
        if (place[k] != k) {
            place[k] = place[place[k]];
            continue;
        }
        for (std::vector<Point>& points : scene.frames)
            points[kept] = points[k];
        place[k] = kept++;
    }
    const std::uint64_t joined = place.size() - kept;
    for (std::vector<Point>& points : scene.frames)
        points.resize(kept);
    for (Face& face : scene.faces)
        face = {place[face.a], place[face.b], place[face.c]};
    scene.reading.joined_vertices += joined;
    if (joined > 0)
        scene.folder.clear();  // its ground truth numbers other vertices
    if (scene.objects_are_parts)
        group_by_parts(scene);
    return finished(std::move(scene));
}

}  // namespace bvhbench
