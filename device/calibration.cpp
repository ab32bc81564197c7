// SPDX-License-Identifier: MIT
#include "device/calibration.h"

#include <algorithm>
#include <array>

namespace bvhbench {
namespace {

// Some 100 to 200 µs on two cores, some 30 on a large GPU: short beside what it stands between.
constexpr cl_uint cpu_count = 1u << 15;
constexpr cl_uint gpu_count = 1u << 22;
constexpr cl_uint rounds = 8;
constexpr std::size_t launches = 3;

}  // namespace

Calibration::Calibration(Programs& programs, Queue& queue)
{
    const Device& device = programs.device();
    const cl_uint count = device.is_cpu() ? cpu_count : gpu_count;
    arena_ = Arena::reserved(
        device, {.tree_bytes = 0, .scratch_bytes = std::size_t{count} * sizeof(cl_uint4)});
    memory_ = arena_->take<cl_uint4>(count, Use::scratch);
    launch_ = filling_launch(device);
    work_ = programs.kernel("device/limits.cl", "calibrate");
    set_arguments(work_, memory_, count, rounds);
    queue.cl().enqueueFillBuffer(memory_.cl(), cl_uint{0}, 0, memory_.bytes());
    take(queue);
}

std::int64_t Calibration::take(Queue& queue)
{
    std::array<std::int64_t, launches> times{};
    for (std::size_t i = 0; i < launches; ++i) {
        queue.begin("calibration");
        queue.launch(work_, launch_.work_items, launch_.group, 0);
    }
    const std::vector<StageTime> stages = queue.finish();
    std::transform(stages.begin(), stages.end(), times.begin(),
                   [](const StageTime& stage) { return stage.busy_ns; });
    std::nth_element(times.begin(), times.begin() + launches / 2, times.end());
    return times[launches / 2];
}

}  // namespace bvhbench
