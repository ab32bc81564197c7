// SPDX-License-Identifier: MIT
//
// Host-side properties and references of the axes' inputs.
#include <algorithm>
#include <cmath>

#include "builders/stages/codes.h"
#include "harness/accuracy/axis.h"

namespace bvhbench {
namespace {

constexpr std::pair<double WidePoint::*, float Point::*> axes[] = {
    {&WidePoint::x, &Point::x}, {&WidePoint::y, &Point::y}, {&WidePoint::z, &Point::z}};

Bounds bounds_of(std::span<const Point> points, std::span<const Face> faces)
{
    Bounds bounds = empty_bounds();
    for (const Face& face : faces)
        bounds = grown(bounds, face_box(points, face));
    return bounds;
}

/// Returns the longest side of the points' box; on(axis) is the coordinate's member.
template <class Points, class On>
double longest_of(const Points& points, On on)
{
    double longest = 0;
    for (const auto& axis : axes) {
        const auto [low, high] = std::ranges::minmax(points, {}, on(axis));
        longest = std::max(longest, double{high.*on(axis)} - double{low.*on(axis)});
    }
    return longest;
}

}  // namespace

double longest_side(std::span<const Point> points)
{
    return longest_of(points, [](const auto& axis) { return axis.second; });
}

CodeCounts code_counts(const OrderEntry& order, std::span<const Point> points,
                       std::span<const Face> faces, std::span<const FaceRange> objects,
                       GridOver grid)
{
    const unsigned dropped = order.code_bits - kept_code_bits(order.code_bits, objects.size());
    const Bounds all = bounds_of(points, faces);
    CodeCounts counts;
    for (const FaceRange& object : objects) {
        const auto own = faces.subspan(object.first, object.count);
        const Bounds bounds = grid == GridOver::scene ? all : bounds_of(points, own);
        std::vector<ulong> codes;
        codes.reserve(own.size());
        for (const Face& face : own)
            codes.push_back(order.code(face_box(points, face), bounds) >> dropped);
        std::ranges::sort(codes);
        for (auto run = codes.begin(), next = run; run != codes.end(); run = next) {
            next = std::upper_bound(run, codes.end(), *run);
            const auto length = static_cast<std::size_t>(next - run);
            counts.duplicates += length - 1;
            counts.longest_run = std::max(counts.longest_run, length);
        }
    }
    return counts;
}

std::vector<WidePoint> turned_and_moved(std::span<const Point> points, double sizes)
{
    // Rotation by one radian about z, then about x: no coordinate remains a float.
    const double c = std::cos(1.0), s = std::sin(1.0);
    std::vector<WidePoint> turned;
    turned.reserve(points.size());
    for (const Point p : points) {
        const double x = c * double{p.x} - s * double{p.y}, y = s * double{p.x} + c * double{p.y};
        turned.push_back({x, c * y - s * double{p.z}, s * y + c * double{p.z}});
    }
    const double by = sizes * longest_of(turned, [](const auto& axis) { return axis.first; });
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

std::vector<Point> on_a_grid(std::span<const Point> points, unsigned bits)
{
    std::vector<Point> moved(points.begin(), points.end());
    const double cell = longest_side(points) / (std::exp2(bits) - 1);
    if (!(cell > 0))
        return moved;
    for (const auto& [wide, narrow] : axes) {
        const double low = std::ranges::min(points, {}, narrow).*narrow;
        for (Point& p : moved)
            p.*narrow = static_cast<float>(low + cell * std::round((p.*narrow - low) / cell));
    }
    return moved;
}

}  // namespace bvhbench
