// SPDX-License-Identifier: MIT
#include "device/copy_rate.h"

#include <algorithm>
#include <vector>

#include "device/arena.h"

namespace bvhbench {

CopyRate measure_copy_rate(Programs& programs, Queue& queue)
{
    const Device& device = programs.device();
    constexpr int samples = 11;
    // Well past any last-level cache, and short enough for a slow host: 128 MiB there, 1 GiB on a GPU.
    const std::size_t bytes = std::size_t{device.is_cpu() ? 128u : 1024u} << 20;
    const auto count = static_cast<cl_uint>(bytes / sizeof(cl_uint4));
    const std::size_t cores = device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    const std::size_t global = device.is_cpu() ? 4 * cores : std::size_t{count};
    const std::size_t local = device.is_cpu() ? 1 : 256;

    Arena arena = Arena::reserved(device, {.tree_bytes = 0, .scratch_bytes = 2 * bytes});
    const Buffer<cl_uint4> from = arena.take<cl_uint4>(count, Use::scratch);
    const Buffer<cl_uint4> to = arena.take<cl_uint4>(count, Use::scratch);
    cl::Kernel copy =
        programs.kernel("device/copy_rate.cl", device.is_cpu() ? "copy_runs" : "copy_strided");
    set_arguments(copy, from, to, count);

    std::vector<double> rates;
    queue.begin("clear");
    queue.clear(from.cl(), from.bytes());  // first touch is the system's cost, not the copy's
    queue.clear(to.cl(), to.bytes());
    for (int i = 0; i <= samples; ++i) {
        queue.begin("copy");
        queue.launch(copy, global, local, static_cast<std::int64_t>(2 * bytes));
        const StageTime time = queue.finish().back();
        if (i > 0)  // the first one warms up
            rates.push_back(static_cast<double>(2 * bytes) /
                            (static_cast<double>(std::max<std::int64_t>(1, time.busy_ns)) * 1e-9));
    }
    std::nth_element(rates.begin(), rates.begin() + samples / 2, rates.end());
    return {rates[samples / 2], bytes, samples};
}

}  // namespace bvhbench
