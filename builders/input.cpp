// SPDX-License-Identifier: MIT
#include "builders/input.h"

#include <algorithm>

namespace bvhbench {
namespace {

template <class T>
Buffer<T> copied(const Device& device, const Queue& queue, std::span<const T> values,
                 std::vector<MemoryShare>& memory)
{
    memory.push_back(device.take_memory(values.size_bytes()));
    Buffer<T> buffer(cl::Buffer(device.context, CL_MEM_READ_ONLY, values.size_bytes()),
                     values.size());
    buffer.upload(queue.cl(), values);
    return buffer;
}

}  // namespace

Input upload(const Device& device, const Queue& queue, std::span<const Point> points,
             std::span<const Face> faces, std::span<const FaceRange> objects)
{
    Input input{points, faces, {}, {}, {}, {}};
    input.device_points = copied(device, queue, points, input.memory);
    input.device_faces = copied(device, queue, faces, input.memory);
    input.objects.assign(objects.begin(), objects.end());
    if (objects.empty())
        input.objects = {{0, static_cast<uint>(faces.size())}};
    std::vector<uint> owners(input.objects.size() > 1 ? faces.size() : 1, 0u);
    if (input.objects.size() > 1)
        for (uint object = 0; object < input.objects.size(); ++object)
            std::fill_n(owners.begin() + input.objects[object].first, input.objects[object].count,
                        object);
    input.device_owners = copied<uint>(device, queue, owners, input.memory);
    return input;
}

std::vector<uint> object_sizes(const Input& input)
{
    std::vector<uint> sizes;
    for (const FaceRange& object : input.objects)
        sizes.push_back(object.count);
    return sizes;
}

}  // namespace bvhbench
