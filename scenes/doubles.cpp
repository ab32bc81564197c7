// SPDX-License-Identifier: MIT
#include "scenes/doubles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// Range of all finite coordinates along an axis.
struct Extent {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();

    void grow(double x)
    {
        if (!std::isfinite(x))
            return;
        low = std::min(low, x);
        high = std::max(high, x);
    }
    // Halves both ends before adding, so that no sum overflows.
    double middle() const { return low <= high ? 0.5 * low + 0.5 * high : 0; }
    double half() const { return low <= high ? 0.5 * high - 0.5 * low : 0; }
    /// Returns the middle with so few digits that subtracting it is often exact: a multiple of a power of two above half of the extent.
    double short_middle() const
    {
        const double unit = half() > 0 ? std::ldexp(1.0, std::ilogb(half()) + 1) : 0;
        return unit > 0 ? std::nearbyint(middle() / unit) * unit : middle();
    }
};

/// True if x - offset has no rounding error: the error is itself a double, which four more operations give [Shewchuk1997].
bool is_exact(double x, double offset)
{
    const double moved = x - offset, taken = x - moved;
    return (x - (moved + taken)) + (taken - offset) == 0;
}

/// Returns 0 if floats of this size are normal and twice the size is one too; else the power of two that scales it to about 1.
int scale_for(double largest)
{
    if (largest == 0)
        return 0;
    const int exponent = std::ilogb(largest);
    const bool fits = exponent < 126 && exponent - 23 >= -126;
    return fits ? 0 : -exponent;
}

/// Returns an offset near the middle along an axis whose subtraction is exact for all coordinates; 0 if that of short_middle is not.
double exact_offset(std::span<const std::vector<WidePoint>> wide, double WidePoint::*axis)
{
    Extent extent;
    for (const std::vector<WidePoint>& points : wide)
        for (const WidePoint& point : points)
            extent.grow(point.*axis);
    const double offset = extent.short_middle();
    for (const std::vector<WidePoint>& points : wide)
        for (const WidePoint& point : points)
            if (!is_exact(point.*axis, offset))
                return 0;
    return offset;
}

/// Moves and scales `x`, and rounds it to the nearest float.
float nearest(double x, double offset, int scale_log2)
{
    // C++ leaves the conversion of values beyond the range of floats undefined.
    constexpr double largest = std::numeric_limits<float>::max();
    const double moved = std::ldexp(x - offset, scale_log2);
    if (std::isnan(moved))
        return NAN;
    if (std::fabs(moved) > largest)
        return moved > 0 ? INFINITY : -INFINITY;
    return static_cast<float>(moved);
}

/// Records the rounding error of x and returns `rounded`.
float counted(float rounded, double x, double offset, Rounding& rounding)
{
    const long double back = std::ldexp(static_cast<long double>(rounded), -rounding.scale_log2);
    const auto error = static_cast<double>(
        std::fabs(back + static_cast<long double>(offset) - static_cast<long double>(x)));
    rounding.rounded_count += error != 0 ? 1 : 0;
    rounding.largest_error = std::max(rounding.largest_error, error);
    return rounded;
}

}  // namespace

std::string_view doubles_name(Doubles how)
{
    return how == Doubles::recentred ? "recentred" : how == Doubles::as_is ? "as-is" : "kept";
}

Doubles doubles_called(std::string_view name)
{
    for (const Doubles how : {Doubles::recentred, Doubles::as_is, Doubles::kept})
        if (doubles_name(how) == name)
            return how;
    throw BadUsage("doubles are read recentred, as-is or kept, not '" + std::string(name) + "'");
}

std::string rounding_text(const Rounding& rounding)
{
    if (!rounding.how)
        return "floats hold all coordinates";
    std::array<char, 200> part{};
    const double digit = std::pow(10, std::floor(std::log10(rounding.largest_error)));
    std::snprintf(
        part.data(), part.size(), "%.1g",
        rounding.largest_error > 0 ? digit * std::ceil(rounding.largest_error / digit) : 0);
    std::string text =
        "coordinates moved by at most " + std::string(part.data()) + ": doubles, as floats";
    if (*rounding.how != Doubles::as_is) {
        const auto& [x, y, z] = rounding.offset;
        std::snprintf(part.data(), part.size(), " around (%.3g, %.3g, %.3g)", x, y, z);
        text += x != 0 || y != 0 || z != 0 ? part.data() : "";
        if (rounding.scale_log2 != 0)
            text += ", scaled by 2^" + std::to_string(rounding.scale_log2);
        text += *rounding.how == Doubles::kept ? ", and kept for steps between frames" : "";
    }
    return text;
}

Rounding round_frames(std::span<const std::vector<WidePoint>> wide, Doubles how,
                      std::vector<std::vector<Point>>& frames)
{
    assert(wide.size() == frames.size());
    Rounding rounding{.how = how};
    if (how == Doubles::recentred) {
        Extent x, y, z;
        for (const std::vector<WidePoint>& points : wide)
            for (const WidePoint& point : points) {
                x.grow(point.x);
                y.grow(point.y);
                z.grow(point.z);
            }
        rounding.offset = {x.middle(), y.middle(), z.middle()};
        rounding.scale_log2 = scale_for(std::max({x.half(), y.half(), z.half()}));
    }
    if (how == Doubles::kept)
        for (double WidePoint::*const axis : {&WidePoint::x, &WidePoint::y, &WidePoint::z})
            rounding.offset.*axis = exact_offset(wide, axis);
    const auto made = [&](float as_is, double x, double offset) {
        const float rounded =
            how == Doubles::as_is ? as_is : nearest(x, offset, rounding.scale_log2);
        return counted(rounded, x, offset, rounding);
    };
    for (std::size_t frame = 0; frame < wide.size(); ++frame) {
        assert(wide[frame].size() == frames[frame].size());
        for (std::size_t k = 0; k < wide[frame].size(); ++k) {
            const WidePoint& from = wide[frame][k];
            Point& to = frames[frame][k];
            to = {made(to.x, from.x, rounding.offset.x), made(to.y, from.y, rounding.offset.y),
                  made(to.z, from.z, rounding.offset.z)};
        }
    }
    return rounding;
}

}  // namespace bvhbench
