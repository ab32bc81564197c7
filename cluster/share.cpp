// SPDX-License-Identifier: MIT
#include "cluster/share.h"

#include <algorithm>
#include <cassert>

#include "geometry/scene_bounds.h"

namespace bvhbench {
namespace {

Share received(std::vector<std::vector<CarriedTriangle>> to, Ranks& ranks)
{
    std::vector<CarriedTriangle> all;
    for (std::vector<CarriedTriangle>& from : exchanged(ranks, std::move(to))) {
        all.insert(all.end(), from.begin(), from.end());
        from = {};
    }
    return share_of(std::move(all));
}

}  // namespace

Share share_of(std::vector<CarriedTriangle> carried)
{
    std::ranges::sort(carried, {}, &CarriedTriangle::id);
    Share share;
    for (const CarriedTriangle& one : carried)
        for (const uint vertex : {one.vertices.a, one.vertices.b, one.vertices.c})
            share.vertices.push_back(vertex);
    std::ranges::sort(share.vertices);
    share.vertices.erase(std::unique(share.vertices.begin(), share.vertices.end()),
                         share.vertices.end());
    share.points.resize(share.vertices.size());
    const auto place = [&](uint vertex, Point at) {
        const auto found = std::ranges::lower_bound(share.vertices, vertex);
        const auto k = static_cast<uint>(found - share.vertices.begin());
        share.points[k] = at;
        return k;
    };
    for (const CarriedTriangle& one : carried) {
        share.ids.push_back(one.id);
        share.faces.push_back({place(one.vertices.a, one.corners[0]),
                               place(one.vertices.b, one.corners[1]),
                               place(one.vertices.c, one.corners[2])});
    }
    return share;
}

Share dealt(std::span<const Point> points, std::span<const Face> faces, uint holder, Ranks& ranks)
{
    std::vector<std::vector<CarriedTriangle>> to(ranks.count());
    if (ranks.rank() == holder)
        for (std::size_t k = 0; k < faces.size(); ++k) {
            const Face face = faces[k];
            to[k * to.size() / faces.size()].push_back(
                {static_cast<uint>(k), face, {points[face.a], points[face.b], points[face.c]}});
        }
    return received(std::move(to), ranks);
}

Share moved(const Share& share, std::span<const uint> to, Ranks& ranks)
{
    assert(to.size() == share.ids.size());
    std::vector<std::vector<CarriedTriangle>> leaving(ranks.count());
    for (std::size_t k = 0; k < to.size(); ++k) {
        const Face face = share.faces[k];
        leaving[to[k]].push_back(
            {share.ids[k],
             share.scene_face(k),
             {share.points[face.a], share.points[face.b], share.points[face.c]}});
    }
    return received(std::move(leaving), ranks);
}

std::vector<Point> box_centres(const Share& share)
{
    std::vector<Point> centres;
    centres.reserve(share.faces.size());
    for (const Face face : share.faces)
        centres.push_back(box_centre(face_box(share.points, face)));
    return centres;
}

}  // namespace bvhbench
