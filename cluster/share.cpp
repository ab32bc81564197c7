// SPDX-License-Identifier: MIT
#include "cluster/share.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "cluster/vertex_numbers.h"
#include "geometry/cores.h"
#include "geometry/scene_bounds.h"

namespace bvhbench {
namespace {

using Carried = std::vector<std::vector<CarriedTriangle>>;

template <class Work>
void each(const Carried& carried, const Work& work)
{
    for (const std::vector<CarriedTriangle>& run : carried)
        for (const CarriedTriangle& one : run)
            work(one);
}

bool ascends(const Carried& carried)
{
    bool result = true;
    std::int64_t last = -1;
    each(carried, [&](const CarriedTriangle& one) {
        result = result && last < one.id;
        last = one.id;
    });
    return result;
}

/// Returns the triangles in one piece, ascending.
Carried sorted(Carried carried)
{
    std::vector<CarriedTriangle> all;
    for (std::vector<CarriedTriangle>& run : carried) {
        all.insert(all.end(), run.begin(), run.end());
        run = {};
    }
    std::ranges::sort(all, {}, &CarriedTriangle::id);
    Carried result;
    result.push_back(std::move(all));
    return result;
}

}  // namespace

CarriedTriangle carried_triangle(const Share& share, std::size_t k)
{
    const Face face = share.faces[k];
    return {share.ids[k],
            share.scene_face(k),
            {share.points[face.a], share.points[face.b], share.points[face.c]}};
}

Share share_of(Carried carried)
{
    if (!ascends(carried))
        carried = sorted(std::move(carried));
    std::size_t count = 0;
    uint least = 0xffffffffu, most = 0;
    each(carried, [&](const CarriedTriangle& one) {
        ++count;
        least = std::min({least, one.vertices.a, one.vertices.b, one.vertices.c});
        most = std::max({most, one.vertices.a, one.vertices.b, one.vertices.c});
    });
    Share share;
    if (count == 0)
        return share;
    VertexNumbers numbers(least, most);
    each(carried, [&](const CarriedTriangle& one) {
        for (const uint vertex : {one.vertices.a, one.vertices.b, one.vertices.c})
            numbers.add(vertex);
    });
    share.vertices = numbers.numbered();
    share.points.resize(share.vertices.size());
    share.ids.reserve(count);
    share.faces.reserve(count);
    each(carried, [&](const CarriedTriangle& one) {
        const Face face = {numbers.place(one.vertices.a), numbers.place(one.vertices.b),
                           numbers.place(one.vertices.c)};
        share.points[face.a] = one.corners[0];
        share.points[face.b] = one.corners[1];
        share.points[face.c] = one.corners[2];
        share.ids.push_back(one.id);
        share.faces.push_back(face);
    });
    return share;
}

Share share_of(MeshRun run, uint first_id)
{
    Share share;
    if (run.faces.empty())
        return share;
    VertexNumbers numbers(run.vertices.front(), run.vertices.back());
    for (const uint vertex : run.vertices)
        numbers.add(vertex);
    share.vertices = numbers.numbered();
    for (Face& face : run.faces)
        face = {numbers.place(face.a), numbers.place(face.b), numbers.place(face.c)};
    share.faces = std::move(run.faces);
    share.points = std::move(run.points);
    share.ids.resize(share.faces.size());
    std::iota(share.ids.begin(), share.ids.end(), first_id);
    return share;
}

Share first_of(const Share& share, std::size_t count)
{
    Carried first(1);
    for (std::size_t k = 0; k < count; ++k)
        first[0].push_back(carried_triangle(share, k));
    return share_of(std::move(first));
}

Share dealt(std::span<const Point> points, std::span<const Face> faces, uint holder, Ranks& ranks)
{
    Carried to(ranks.count());
    if (ranks.rank() == holder)
        for (std::size_t k = 0; k < faces.size(); ++k) {
            const Face face = faces[k];
            to[k * to.size() / faces.size()].push_back(
                {static_cast<uint>(k), face, {points[face.a], points[face.b], points[face.c]}});
        }
    return share_of(exchanged(ranks, std::move(to)));
}

Share moved(Share share, std::span<const uint> to, Ranks& ranks)
{
    assert(to.size() == share.ids.size());
    std::vector<std::size_t> counts(ranks.count());
    for (const uint rank : to)
        ++counts[rank];
    Carried leaving(ranks.count());
    for (std::size_t rank = 0; rank < counts.size(); ++rank)
        leaving[rank].reserve(counts[rank]);
    for (std::size_t k = 0; k < to.size(); ++k)
        leaving[to[k]].push_back(carried_triangle(share, k));
    share = {};
    return share_of(exchanged(ranks, std::move(leaving)));
}

std::vector<Point> box_centres(const Share& share)
{
    constexpr std::size_t block = 1 << 20;
    std::vector<Point> centres(share.faces.size());
    on_all_cores((centres.size() + block - 1) / block, [&](std::size_t part) {
        for (std::size_t k = part * block; k < std::min(centres.size(), (part + 1) * block); ++k)
            centres[k] = box_centre(face_box(share.points, share.faces[k]));
    });
    return centres;
}

}  // namespace bvhbench
