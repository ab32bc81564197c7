// SPDX-License-Identifier: MIT
#include "device/arena.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// Returns a buffer whose memory is really allocated. PoCL allocates a buffer at its first use and ends the process if that
/// fails, so the buffer is written here, right after the check that the memory is free.
cl::Buffer allocated(const Device& device, std::size_t bytes)
{
    cl::Buffer memory(device.context, CL_MEM_READ_WRITE, std::max<std::size_t>(1, bytes));
    if (device.is_cpu()) {
        const cl_uchar zero = 0;
        cl::CommandQueue(device.context, device.cl)
            .enqueueWriteBuffer(memory, CL_TRUE, 0, sizeof zero, &zero);
    }
    return memory;
}

}  // namespace

Arena::Arena(const Device& device, std::size_t capacity)
    : alignment_(device.cl.getInfo<CL_DEVICE_MEM_BASE_ADDR_ALIGN>() / 8), capacity_(capacity)
{}

Arena Arena::measuring(const Device& device)
{
    return {device, std::numeric_limits<std::size_t>::max()};
}

Arena Arena::reserved(const Device& device, const Footprint& footprint)
{
    Arena arena(device, footprint.total());
    arena.share_ = device.take_memory(footprint.total());
    if (footprint.total() > device.most_at_once())
        arena.pieces_ = device;
    else
        arena.memory_ = allocated(device, footprint.total());
    return arena;
}

cl::Buffer Arena::carve(std::size_t bytes, Use use)
{
    const std::size_t end = used_.total();
    const std::size_t start = (end + alignment_ - 1) / alignment_ * alignment_;
    if (bytes > capacity_ - std::min(start, capacity_))
        throw std::logic_error("arena: " + std::to_string(bytes) + " bytes were taken at " +
                               std::to_string(start) + " of " + std::to_string(capacity_) +
                               " predicted");
    used_.scratch_bytes += start - end;
    (use == Use::tree ? used_.tree_bytes : used_.scratch_bytes) += bytes;
    if (bytes == 0)
        return {};
    if (pieces_) {
        pieces_->require_at_once(bytes);
        return allocated(*pieces_, bytes);
    }
    if (!memory_())
        return {};
    const cl_buffer_region region{start, bytes};
    return memory_.createSubBuffer(CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION, &region);
}

}  // namespace bvhbench
