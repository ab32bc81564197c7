// SPDX-License-Identifier: MIT
#include "device/head_start.h"

#include <array>

#include "device/arena.h"

namespace bvhbench {
namespace {

/// Of some four cycles each: 40 to 60 µs on a GPU of 1 to 2 GHz.
constexpr cl_uint rounds = 20'000;

}  // namespace

HeadStart::HeadStart(Programs& programs, const Queue& queue)
{
    if (programs.device().is_cpu())
        return;
    Arena arena = Arena::reserved(programs.device(), {.scratch_bytes = sizeof(cl_uint)});
    word_ = arena.take<cl_uint>(1, Use::scratch);
    word_.upload(queue.cl(), std::array<cl_uint, 1>{0});
    busy_ = programs.kernel("device/limits.cl", "keep_busy");
    set_arguments(busy_, word_, rounds);
}

void HeadStart::give(const Queue& queue)
{
    if (busy_() != nullptr)
        queue.cl().enqueueNDRangeKernel(busy_, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
}

}  // namespace bvhbench
