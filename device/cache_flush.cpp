// SPDX-License-Identifier: MIT
#include "device/cache_flush.h"

#include <algorithm>

namespace bvhbench {
namespace {

/// Twice what the device says it has. Some say too little: never less than 64 MiB, which is past most last levels.
std::size_t buffer_bytes(const Device& device)
{
    const std::size_t cache = device.cl.getInfo<CL_DEVICE_GLOBAL_MEM_CACHE_SIZE>();
    const std::size_t most = std::min(std::size_t{1} << 30, device.most_at_once());
    return std::min(std::max(2 * cache, std::size_t{64} << 20), most) / 16 * 16;
}

}  // namespace

CacheFlush::CacheFlush(Programs& programs, Queue& queue)
{
    const Device& device = programs.device();
    const std::size_t bytes = buffer_bytes(device);
    const auto count = static_cast<cl_uint>(bytes / sizeof(cl_uint4));
    arena_ = Arena::reserved(device, {.tree_bytes = 0, .scratch_bytes = bytes});
    memory_ = arena_->take<cl_uint4>(count, Use::scratch);
    launch_ = filling_launch(device);
    walk_ = programs.kernel("device/limits.cl", "walk");
    set_arguments(walk_, memory_, count);
    queue.cl().enqueueFillBuffer(memory_.cl(), cl_uint{0}, 0, memory_.bytes());
    flush(queue);
}

void CacheFlush::flush(const Queue& queue)
{
    queue.cl().enqueueNDRangeKernel(walk_, cl::NullRange, cl::NDRange(launch_.work_items),
                                    cl::NDRange(launch_.group));
    queue.cl().finish();
}

}  // namespace bvhbench
