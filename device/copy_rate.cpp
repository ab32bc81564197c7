// SPDX-License-Identifier: MIT
#include "device/copy_rate.h"

#include <algorithm>
#include <vector>

#include "device/arena.h"

namespace bvhbench {
namespace {

/// Well past any last-level cache, twice over for each of the two buffers, and short enough for a slow host: whoever
/// asks for one small build waits for it too. 1 GiB on a GPU.
std::size_t buffer_bytes(const Device& device)
{
    if (!device.is_cpu())
        return std::size_t{1} << 30;
    const std::size_t cache = device.cl.getInfo<CL_DEVICE_GLOBAL_MEM_CACHE_SIZE>();
    return std::clamp(2 * cache, std::size_t{64} << 20, std::size_t{512} << 20) / 16 * 16;
}

}  // namespace

CopyRate measure_copy_rate(Programs& programs, Queue& queue)
{
    const Device& device = programs.device();
    constexpr int samples = 9;
    const std::size_t bytes = buffer_bytes(device);
    const auto count = static_cast<cl_uint>(bytes / sizeof(cl_uint4));
    const std::size_t cores = device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    const std::size_t global = device.is_cpu() ? 4 * cores : std::size_t{count};
    const std::size_t local = device.is_cpu() ? 1 : 256;

    Arena arena = Arena::reserved(device, {.tree_bytes = 0, .scratch_bytes = 2 * bytes});
    const Buffer<cl_uint4> from = arena.take<cl_uint4>(count, Use::scratch);
    const Buffer<cl_uint4> to = arena.take<cl_uint4>(count, Use::scratch);
    cl::Kernel copy =
        programs.kernel("device/limits.cl", device.is_cpu() ? "copy_runs" : "copy_strided");
    set_arguments(copy, from, to, count);

    std::vector<std::int64_t> times;
    queue.begin("clear");
    queue.clear(from.cl(), from.bytes());  // memory never written may not be there to be read
    for (int i = 0; i <= samples; ++i) {
        queue.begin("copy");
        queue.launch(copy, global, local, static_cast<std::int64_t>(2 * bytes));
        const StageTime time = queue.finish().back();
        if (i > 0)  // the first one warms up, and is the first to touch what it writes
            times.push_back(time.busy_ns);
    }
    std::nth_element(times.begin(), times.begin() + samples / 2, times.end());
    const auto median = static_cast<double>(times[samples / 2]);
    return {median > 0 ? static_cast<double>(2 * bytes) / (median * 1e-9) : 0, bytes, samples};
}

}  // namespace bvhbench
