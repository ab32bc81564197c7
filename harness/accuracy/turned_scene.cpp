// SPDX-License-Identifier: MIT
#include "harness/accuracy/turned_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bvhbench {
namespace {

struct WideBox {
    WidePoint min, max;
};

WidePoint lower(WidePoint a, WidePoint b)
{
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

WidePoint upper(WidePoint a, WidePoint b)
{
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

WideBox box_of(std::span<const WidePoint> points)
{
    WideBox box = {points.front(), points.front()};
    for (const WidePoint p : points)
        box = {lower(box.min, p), upper(box.max, p)};
    return box;
}

bool overlap(const WideBox& a, const WideBox& b)
{
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
           a.min.z <= b.max.z && b.min.z <= a.max.z;
}

double longest_side(const WideBox& box)
{
    return std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z});
}

}  // namespace

std::vector<WidePoint> turned_and_moved(std::span<const Point> points, double sizes)
{
    // One radian about z, then one about x: no coordinate is a float afterwards.
    const double c = std::cos(1.0), s = std::sin(1.0);
    std::vector<WidePoint> turned;
    turned.reserve(points.size());
    for (const Point p : points) {
        const double x = c * double{p.x} - s * double{p.y}, y = s * double{p.x} + c * double{p.y};
        turned.push_back({x, c * y - s * double{p.z}, s * y + c * double{p.z}});
    }
    const double by = turned.empty() ? 0 : sizes * longest_side(box_of(turned));
    for (WidePoint& p : turned)
        p = {p.x + by, p.y + by, p.z + by};
    return turned;
}

std::vector<Point> rounded(const std::vector<WidePoint>& points, Doubles how)
{
    std::vector<std::vector<Point>> frames(1);
    for (const WidePoint p : points)
        frames[0].push_back(
            {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    round_frames({&points, 1}, how, frames);
    return std::move(frames[0]);
}

PairList overlapping_pairs_in_doubles(std::span<const WidePoint> points,
                                      std::span<const Face> faces)
{
    std::vector<WideBox> boxes;
    boxes.reserve(faces.size());
    for (const Face face : faces) {
        const WidePoint corners[] = {points[face.a], points[face.b], points[face.c]};
        boxes.push_back(box_of(corners));
    }
    std::vector<uint> ids(faces.size());
    std::iota(ids.begin(), ids.end(), 0u);
    std::sort(ids.begin(), ids.end(),
              [&](uint a, uint b) { return boxes[a].min.x < boxes[b].min.x; });
    std::vector<Pair> found;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const WideBox& box = boxes[ids[i]];
        for (std::size_t j = i + 1; j < ids.size() && boxes[ids[j]].min.x <= box.max.x; ++j)
            if (overlap(box, boxes[ids[j]]))
                found.push_back({ids[i], ids[j]});
    }
    return PairList(std::move(found));
}

}  // namespace bvhbench
