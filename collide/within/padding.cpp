// SPDX-License-Identifier: MIT
#include "collide/within/padding.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "collide/device_lists.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint padding_group_size = 256;

}  // namespace

Padding::Padding(Programs& programs, KernelForm form, bool of_step)
    : programs_(programs), form_(chosen_form(programs.device(), form)), of_step_(of_step)
{
    kernel_ = of_step ? programs.kernel("collide/separation/pad_step.cl", "pad_step")
                      : programs.kernel("collide/within/pad.cl", "pad_points");
}

void Padding::reserve(std::size_t points)
{
    take_memory(arena_, programs_.device(), [&](Arena& arena) {
        low_ends_ = arena.take<Point>(points, Use::scratch);
        high_ends_ = arena.take<Point>(points, Use::scratch);
    });
}

Input Padding::padded(const Input& input, float reach, Queue& queue)
{
    assert(arena_ && "reserve first");
    const auto count = static_cast<uint>(low_ends_.size());
    queue.begin("pad");
    if (of_step_)
        set_arguments(kernel_, input.device_points, input.device_end_points, reach, low_ends_,
                      high_ends_, count);
    else
        set_arguments(kernel_, input.device_points, reach, low_ends_, high_ends_, count);
    const bool in_groups = form_ == KernelForm::groups;
    const std::size_t groups = divided_up(count, padding_group_size);
    queue.launch(kernel_, in_groups ? groups * padding_group_size : chunk_count(programs_.device()),
                 in_groups ? padding_group_size : 1,
                 static_cast<std::int64_t>((of_step_ ? 4 : 3) * low_ends_.bytes()));
    return input.between(low_ends_, high_ends_);
}

float reach_of(double distance)
{
    constexpr float most = std::numeric_limits<float>::max();  // spans any two floats
    const double half = distance / 2;
    if (distance == 0 || half >= most)
        return distance == 0 ? 0 : most;
    const auto near = static_cast<float>(half);
    return std::max(std::nextafter(near, most), std::numeric_limits<float>::min());  // no denormal
}

double distance_of_floats(const Input& input, double distance)
{
    double largest = 0;
    if (input.is_wide())
        for (const auto& points : {input.points, input.end_points})
            for (const Point p : points)
                largest = std::max<double>({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return distance + 0x1p-22 * largest;  // two coordinates are each off by 2^-24 of themselves
}

}  // namespace bvhbench
