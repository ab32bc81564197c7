// SPDX-License-Identifier: MIT
#include "library/input.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/error.h"

namespace bvhbench::oibvh {
namespace {

// The builders' types.
using OwnPoint = bvhbench::Point;
using OwnFace = bvhbench::Face;

static_assert(sizeof(OwnPoint) == sizeof(oibvh::Point) && sizeof(OwnFace) == sizeof(oibvh::Face) &&
              2 * sizeof(OwnPoint) == sizeof(Box));

constexpr std::size_t most_leaves = std::size_t{1} << 31;

bool may_be_read(const cl::Buffer& buffer)
{
    return (buffer.getInfo<CL_MEM_FLAGS>() & (CL_MEM_HOST_WRITE_ONLY | CL_MEM_HOST_NO_ACCESS)) == 0;
}

}  // namespace

void require_count(std::size_t count, const char* what)
{
    if (count == 0)
        throw BadUsage(std::string("there are no ") + what + ", and a tree has a leaf at least");
    if (count > most_leaves)
        throw BadUsage("there are " + std::to_string(count) + ' ' + what +
                       ", and a tree has 2147483648 leaves at most");
}

std::string text_of(OwnPoint point)
{
    return '(' + std::to_string(point.x) + ", " + std::to_string(point.y) + ", " +
           std::to_string(point.z) + ')';
}

bool is_finite(OwnPoint point)
{
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

InputTaker::InputTaker(Device::Impl& device, bool check) : device_(device), checks_(check)
{
    if (!checks_)
        return;
    triangles_kernel_ = device_.programs.kernel("library/input.cl", "check_triangles");
    boxes_kernel_ = device_.programs.kernel("library/input.cl", "check_boxes");
}

template <class T>
Buffer<T> InputTaker::room_for(std::size_t count, Room& room)
{
    const std::size_t bytes = count * sizeof(T);
    if (bytes != room.memory.size()) {
        room = {};  // freed before the new memory is allocated
        room.arena = Arena::reserved(device_.device, {.tree_bytes = 0, .scratch_bytes = bytes});
        room.memory = room.arena->take<std::byte>(bytes, Use::scratch);
    }
    return room.memory.as<T>();
}

template <class T, class U>
Buffer<T> InputTaker::copied(std::span<const U> values, Room& room)
{
    static_assert(sizeof(T) == sizeof(U) || sizeof(U) % sizeof(T) == 0);
    const Buffer<T> buffer = room_for<T>(values.size_bytes() / sizeof(T), room);
    device_.queue.cl().enqueueWriteBuffer(buffer.cl(), CL_TRUE, 0, values.size_bytes(),
                                          values.data());
    return buffer;
}

template <class T>
Buffer<T> InputTaker::callers(cl_mem memory, std::size_t count, std::size_t item_bytes,
                              const char* what) const
{
    if (memory == nullptr)
        throw BadUsage(std::string("the buffer of ") + what + " is null");
    const cl::Buffer buffer(memory, true);
    if (buffer.getInfo<CL_MEM_TYPE>() != CL_MEM_OBJECT_BUFFER)
        throw BadUsage(std::string(what) + " are in an image, and a buffer is wanted");
    if (context_of(clGetMemObjectInfo, memory, CL_MEM_CONTEXT, "clGetMemObjectInfo") !=
        device_.device.context())
        throw BadUsage(std::string("the buffer of ") + what +
                       " is of another context than the queue");
    if ((buffer.getInfo<CL_MEM_FLAGS>() & CL_MEM_WRITE_ONLY) != 0)
        throw BadUsage(std::string("the buffer of ") + what +
                       " is write-only to kernels, and they have to read it");
    const std::size_t bytes = buffer.getInfo<CL_MEM_SIZE>();
    if (bytes / item_bytes < count)
        throw BadUsage(std::to_string(count) + ' ' + what + " of " + std::to_string(item_bytes) +
                       " bytes do not fit into their buffer of " + std::to_string(bytes));
    return {buffer, count * (item_bytes / sizeof(T))};
}

const bvhbench::Input& InputTaker::take(const Input& input, std::span<const std::uint32_t> sizes)
{
    are_boxes_ =
        std::holds_alternative<HostBoxes>(input) || std::holds_alternative<DeviceBoxes>(input);
    // Releases the caller's former buffers, lest a failed call retain them, and copies that this kind of input does not use.
    taken_.device_points = {};
    taken_.device_faces = {};
    if (!are_boxes_) {
        box_faces_made_ = 0;
        box_faces_ = {};
    }
    if (!std::holds_alternative<HostTriangles>(input))
        faces_ = {};
    if (const auto* mesh = std::get_if<HostTriangles>(&input)) {
        require_count(mesh->faces.size(), "triangles");
        require_count(mesh->points.size(), "points");
        taken_.device_points = copied<OwnPoint>(mesh->points, points_);
        taken_.device_faces = copied<OwnFace>(mesh->faces, faces_);
    } else if (const auto* all = std::get_if<HostBoxes>(&input)) {
        require_count(all->boxes.size(), "boxes");
        take_boxes(copied<OwnPoint>(all->boxes, points_));
    } else if (const auto* theirs = std::get_if<DeviceTriangles>(&input)) {
        points_ = {};
        require_count(theirs->face_count, "triangles");
        if (theirs->point_count == 0)
            require_count(0, "points");
        Buffer<OwnPoint> points =
            callers<OwnPoint>(theirs->points, theirs->point_count, sizeof(OwnPoint), "points");
        taken_.device_faces =
            callers<OwnFace>(theirs->faces, theirs->face_count, sizeof(OwnFace), "faces");
        taken_.device_points = std::move(points);
    } else {
        const auto& boxes = std::get<DeviceBoxes>(input);
        points_ = {};
        require_count(boxes.box_count, "boxes");
        take_boxes(callers<OwnPoint>(boxes.boxes, boxes.box_count, sizeof(Box), "boxes"));
    }
    take_objects(sizes);
    if (checks_)
        check();
    return taken_;
}

std::size_t InputTaker::memory() const
{
    std::size_t bytes = 0;
    for (const Room* room : {&points_, &faces_, &box_faces_, &owners_, &flag_})
        bytes += room->memory.bytes();
    return bytes;
}

void InputTaker::take_boxes(const Buffer<OwnPoint>& corners)
{
    const std::size_t count = corners.size() / 2;
    const bool are_made = std::exchange(box_faces_made_, 0) == count;
    const Buffer<OwnFace> faces = room_for<OwnFace>(count, box_faces_);
    if (!are_made) {
        if (faces_kernel_() == nullptr)
            faces_kernel_ = device_.programs.kernel("library/input.cl", "box_faces");
        set_arguments(faces_kernel_, faces, static_cast<uint>(count));
        device_.queue.begin("input");
        device_.launch(faces_kernel_, count);
    }
    box_faces_made_ = count;
    taken_.device_points = corners;
    taken_.device_faces = faces;
}

void InputTaker::take_objects(std::span<const std::uint32_t> sizes)
{
    const std::size_t count = taken_.device_faces.size();
    std::vector<FaceRange> objects;
    std::size_t first = 0;
    for (const std::uint32_t size : sizes) {
        if (size == 0)
            throw BadUsage("object " + std::to_string(objects.size()) +
                           " is empty, and a tree has a leaf at least");
        objects.push_back({static_cast<uint>(first), size});
        first += size;
    }
    if (objects.empty())
        objects.push_back({0, static_cast<uint>(first = count)});
    if (first != count)
        throw BadUsage("the objects' sizes come to " + std::to_string(first) + ", and there are " +
                       std::to_string(count) + " triangles or boxes");
    if (objects == taken_.objects && taken_.device_owners.size() > 0)
        return;
    taken_.objects.clear();  // set once their owners are uploaded
    taken_.device_owners = {};
    std::vector<uint> owners(objects.size() > 1 ? count : 1, 0u);
    for (uint object = 0; objects.size() > 1 && object < objects.size(); ++object)
        std::fill_n(owners.begin() + objects[object].first, objects[object].count, object);
    taken_.device_owners = copied<uint>(std::span<const uint>(owners), owners_);
    taken_.objects = std::move(objects);
}

void InputTaker::check()
{
    Queue& queue = device_.queue;
    const Buffer<uint> is_bad = room_for<uint>(1, flag_);
    const Buffer<OwnPoint>& points = taken_.device_points;
    const Buffer<OwnFace>& faces = taken_.device_faces;
    const std::size_t count = faces.size();
    cl::Kernel& kernel = are_boxes_ ? boxes_kernel_ : triangles_kernel_;
    if (are_boxes_)
        set_arguments(kernel, points, static_cast<uint>(count), is_bad);
    else
        set_arguments(kernel, points,
                      static_cast<uint>(std::min<std::size_t>(points.size() - 1,
                                                              std::numeric_limits<uint>::max())),
                      faces, static_cast<uint>(count), is_bad);
    queue.begin("check");
    queue.clear(is_bad.cl(), is_bad.bytes());
    device_.launch(kernel, count);
    uint was_bad = 0;
    queue.read(is_bad.cl(), sizeof was_bad, &was_bad);
    if (was_bad != 0)
        complain();
}

/// Throws BadUsage about the first invalid triangle or box.
void InputTaker::complain() const
{
    if (!may_be_read(taken_.device_points.cl()) || !may_be_read(taken_.device_faces.cl()))
        throw BadUsage(
            std::string(are_boxes_
                            ? "a box has a corner that is not finite, or ends before it begins"
                            : "a triangle names a point that is not there, or has a corner that is "
                              "not finite") +
            "; which one cannot be told, since the host may not read the buffer");
    const std::vector<OwnPoint> points = taken_.device_points.download(device_.queue.cl());
    const std::vector<OwnFace> faces = taken_.device_faces.download(device_.queue.cl());
    for (std::size_t k = 0; k < faces.size(); ++k) {
        const std::string which = (are_boxes_ ? "box " : "triangle ") + std::to_string(k);
        for (const uint index : {faces[k].a, faces[k].b, faces[k].c}) {
            if (index >= points.size())
                throw BadUsage(which + " names point " + std::to_string(index) +
                               ", and there are " + std::to_string(points.size()));
            if (!is_finite(points[index]))
                throw BadUsage(which +
                               " has a corner that is not finite: " + text_of(points[index]));
        }
        if (!are_boxes_)
            continue;
        const OwnPoint low = points[2 * k], high = points[2 * k + 1];
        if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z))
            throw BadUsage(which + " ends before it begins: from " + text_of(low) + " to " +
                           text_of(high));
    }
    throw BadUsage("the input changed while it was checked");
}

}  // namespace bvhbench::oibvh
