// SPDX-License-Identifier: MIT
#include "device/launch_cost.h"

#include <algorithm>
#include <vector>

#include "device/arena.h"
#include "device/head_start.h"

namespace bvhbench {

LaunchCost measure_launch_cost(Programs& programs, Queue& queue)
{
    const Device& device = programs.device();
    constexpr int samples = 31;
    constexpr int launches = 16;  // as many as a whole build has, and their gaps
    const std::size_t units = device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    const std::size_t local = device.is_cpu() ? 1 : 64;

    Arena arena = Arena::reserved(device, {.tree_bytes = 0, .scratch_bytes = sizeof(cl_uint)});
    const Buffer<cl_uint> word = arena.take<cl_uint>(1, Use::scratch);
    cl::Kernel empty = programs.kernel("device/limits.cl", "launch_empty");
    set_arguments(empty, word);

    HeadStart head_start(programs, queue);
    std::vector<double> costs;
    queue.begin("clear");
    queue.clear(word.cl(), word.bytes());
    for (int i = 0; i <= samples; ++i) {
        head_start.give(queue);
        queue.begin("launch");
        for (int k = 0; k < launches; ++k)
            queue.launch(empty, units * local, local, 0);
        const StageTime time = queue.finish().back();
        if (i > 0)  // the first one warms up
            costs.push_back(static_cast<double>(time.span_ns) / launches);
    }
    std::nth_element(costs.begin(), costs.begin() + samples / 2, costs.end());
    return {costs[samples / 2], launches, samples};
}

}  // namespace bvhbench
