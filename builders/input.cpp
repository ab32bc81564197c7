// SPDX-License-Identifier: MIT
#include "builders/input.h"

#include <algorithm>
#include <cassert>

#include "geometry/error.h"

namespace bvhbench {
namespace {

template <class T>
Buffer<T> copied(const Device& device, const Queue& queue, std::span<const T> values,
                 std::vector<MemoryShare>& memory)
{
    device.require_at_once(values.size_bytes());
    memory.push_back(device.take_memory(values.size_bytes()));
    Buffer<T> buffer(cl::Buffer(device.context, CL_MEM_READ_ONLY, values.size_bytes()),
                     values.size());
    buffer.upload(queue.cl(), values);
    return buffer;
}

void copy_faces(Input& input, const Device& device, const Queue& queue, std::span<const Face> faces,
                std::span<const FaceRange> objects)
{
    if (device.ends_loops && faces.size() > Device::most_triangles_in_short_loops)
        throw Unavailable(device.name() + " ends loops after 65,535 steps, so it is given up to " +
                          std::to_string(Device::most_triangles_in_short_loops) +
                          " triangles, not " + std::to_string(faces.size()));
    input.faces = faces;
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
}

}  // namespace

Input upload(const Device& device, const Queue& queue, std::span<const Point> points,
             std::span<const Face> faces, std::span<const FaceRange> objects)
{
    Input input{points, {}, {}, {}, {}, {}};
    input.device_points = copied(device, queue, points, input.memory);
    copy_faces(input, device, queue, faces, objects);
    return input;
}

void upload_end(Input& input, const Device& device, const Queue& queue,
                std::span<const Point> end_points)
{
    assert(end_points.size() == input.points.size());
    input.end_points = end_points;
    input.device_end_points = copied(device, queue, end_points, input.memory);
}

void upload_wide(Input& input, const Device& device, const Queue& queue,
                 std::span<const WidePoint> points, std::span<const WidePoint> end_points)
{
    assert(points.size() == input.points.size() && end_points.size() == points.size());
    input.wide = {points, end_points, copied(device, queue, points, input.memory),
                  copied(device, queue, end_points, input.memory)};
}

Input upload_over(const Input& input, const Device& device, const Queue& queue,
                  std::span<const Face> faces, std::span<const FaceRange> objects)
{
    Input other = input;
    copy_faces(other, device, queue, faces, objects);
    return other;
}

std::vector<Aabb> leaf_boxes(const Input& input)
{
    std::vector<Aabb> boxes;
    boxes.reserve(input.faces.size());
    for (const Face face : input.faces)
        boxes.push_back(leaf_box(input, face));
    return boxes;
}

std::vector<uint> object_sizes(const Input& input)
{
    std::vector<uint> sizes;
    for (const FaceRange& object : input.objects)
        sizes.push_back(object.count);
    return sizes;
}

}  // namespace bvhbench
