// SPDX-License-Identifier: MIT
#include "builders/input.h"

namespace bvhbench {
namespace {

template <class T>
Buffer<T> copied(const Device& device, const Queue& queue, std::span<const T> values)
{
    device.require_memory(values.size_bytes());
    Buffer<T> buffer(cl::Buffer(device.context, CL_MEM_READ_ONLY, values.size_bytes()),
                     values.size());
    buffer.upload(queue.cl(), values);
    return buffer;
}

}  // namespace

Input upload(const Device& device, const Queue& queue, std::span<const Point> points,
             std::span<const Face> faces)
{
    return {points, faces, copied(device, queue, points), copied(device, queue, faces)};
}

}  // namespace bvhbench
