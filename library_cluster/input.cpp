// SPDX-License-Identifier: MIT
#include "library_cluster/input.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>

#include "geometry/error.h"
#include "library/input.h"

namespace bvhbench::oibvh {
namespace {

void require_length(const char* numbers, std::size_t count, const char* things, std::size_t wanted)
{
    if (count != wanted)
        throw BadUsage("there are " + std::to_string(count) + " numbers of " + numbers + ", and " +
                       std::to_string(wanted) + ' ' + things);
}

}  // namespace

std::vector<bvhbench::Point> own_points(std::span<const Point> points)
{
    std::vector<bvhbench::Point> own;
    own.reserve(points.size());
    for (const Point point : points)
        own.push_back({point.x, point.y, point.z});
    return own;
}

std::vector<bvhbench::Face> own_faces(std::span<const Face> faces)
{
    std::vector<bvhbench::Face> own;
    own.reserve(faces.size());
    for (const Face face : faces)
        own.push_back({face.a, face.b, face.c});
    return own;
}

Share share_of(const RankTriangles& given)
{
    const auto at = [&](std::uint32_t index) {
        const Point point = given.points[index];
        return bvhbench::Point{point.x, point.y, point.z};
    };
    std::vector<std::vector<CarriedTriangle>> carried(1);
    carried[0].reserve(given.faces.size());
    for (std::size_t k = 0; k < given.faces.size(); ++k) {
        const Face face = given.faces[k];
        carried[0].push_back(
            {given.triangles[k],
             {given.vertices[face.a], given.vertices[face.b], given.vertices[face.c]},
             {at(face.a), at(face.b), at(face.c)}});
    }
    return bvhbench::share_of(std::move(carried));
}

void require_numbers(const RankTriangles& given)
{
    require_length("triangles", given.triangles.size(), "faces", given.faces.size());
    require_length("vertices", given.vertices.size(), "points", given.points.size());
}

void require_count(std::size_t own, Ranks& ranks)
{
    std::array<std::uint64_t, 1> all{own};
    ranks.sum(all);
    oibvh::require_count(all[0], "triangles");
}

void require_corners(std::span<const Face> faces, std::size_t points)
{
    for (std::size_t k = 0; k < faces.size(); ++k)
        for (const std::uint32_t index : {faces[k].a, faces[k].b, faces[k].c})
            if (index >= points)
                throw BadUsage("triangle " + std::to_string(k) + " names point " +
                               std::to_string(index) + ", and there are " + std::to_string(points));
}

void require_finite(std::span<const Point> points)
{
    for (std::size_t k = 0; k < points.size(); ++k)
        if (const bvhbench::Point point{points[k].x, points[k].y, points[k].z}; !is_finite(point))
            throw BadUsage("point " + std::to_string(k) + " is not finite: " + text_of(point));
}

void require_unique(std::span<const std::uint32_t> triangles, Ranks& ranks)
{
    std::vector<std::vector<uint>> to(ranks.count());
    for (const uint number : triangles)
        to[number % ranks.count()].push_back(number);
    std::vector<uint> all;
    for (const std::vector<uint>& from : exchanged(ranks, std::move(to)))
        all.insert(all.end(), from.begin(), from.end());
    std::ranges::sort(all);
    const auto twice = std::ranges::adjacent_find(all);
    constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t own[] = {twice == all.end() ? none : *twice};
    const std::uint64_t least = std::ranges::min(gathered<std::uint64_t>(ranks, own));
    if (least != none)
        throw BadUsage("two triangles have the number " + std::to_string(least));
}

void require_same(const char* what, double value, Ranks& ranks)
{
    const std::vector<double> all = gathered<double>(ranks, std::span<const double>(&value, 1));
    const auto other = std::ranges::find_if(all, [&](double one) { return one != all.front(); });
    if (other == all.end())
        return;
    std::ostringstream text;
    text << std::setprecision(17) << what << " must be the same on all ranks, and is "
         << all.front() << " on rank 0 and " << *other << " on rank " << other - all.begin();
    throw BadUsage(text.str());
}

}  // namespace bvhbench::oibvh
