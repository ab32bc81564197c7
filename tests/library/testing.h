// SPDX-License-Identifier: MIT
//
// Shared by the tests of the library: a caller with its own OpenCL objects, test meshes, and their pairs by the sweep oracle.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "collide/oracles/box_pairs.h"
#include "collide/pairs.h"
#include "device/device.h"
#include "library/include/bvhbench/oibvh.h"
#include "scenes/catalog.h"
#include "tests/refusal.h"

namespace bvhbench {

/// A caller's device, context and queue, created and released with OpenCL's C functions.
struct Caller {
    cl_device_id device = nullptr;
    cl_context context = nullptr;
    cl_command_queue queue = nullptr;

    explicit Caller(cl_command_queue_properties properties = 0,
                    std::vector<cl_device_id> devices = {})
    {
        if (devices.empty())
            devices.push_back(open_device("").cl());
        device = devices.back();
        context = clCreateContext(nullptr, static_cast<cl_uint>(devices.size()), devices.data(),
                                  nullptr, nullptr, nullptr);
        queue = clCreateCommandQueue(context, device, properties, nullptr);
    }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;
    ~Caller()
    {
        for (const cl_mem buffer : buffers_)
            clReleaseMemObject(buffer);
        clReleaseCommandQueue(queue);
        clReleaseContext(context);
    }

    /// Returns a buffer that holds `values`. The caller owns it and releases it in its destructor.
    template <class T>
    cl_mem buffer_of(const std::vector<T>& values)
    {
        buffers_.push_back(clCreateBuffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                                          values.size() * sizeof(T), const_cast<T*>(values.data()),
                                          nullptr));
        return buffers_.back();
    }

    template <class T>
    std::vector<T> values_of(cl_mem buffer, std::size_t count) const
    {
        std::vector<T> values(count);
        clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, count * sizeof(T), values.data(), 0, nullptr,
                            nullptr);
        return values;
    }

    const std::vector<cl_mem>& buffers() const { return buffers_; }

    /// Returns the sum of the reference counts of the queue, the context and all buffers, once it has stopped changing: PoCL drops
    /// those of commands that have ended a little later, on a thread of its own.
    cl_uint references() const
    {
        for (cl_uint last = references_now();;) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            const cl_uint now = references_now();
            if (now == last)
                return now;
            last = now;
        }
    }

private:
    cl_uint references_now() const
    {
        cl_uint of_queue = 0, of_context = 0, of_buffers = 0;
        clGetCommandQueueInfo(queue, CL_QUEUE_REFERENCE_COUNT, sizeof of_queue, &of_queue, nullptr);
        clGetContextInfo(context, CL_CONTEXT_REFERENCE_COUNT, sizeof of_context, &of_context,
                         nullptr);
        for (const cl_mem buffer : buffers_) {
            cl_uint own = 0;
            clGetMemObjectInfo(buffer, CL_MEM_REFERENCE_COUNT, sizeof own, &own, nullptr);
            of_buffers += own;
        }
        return of_queue + of_context + of_buffers;
    }

    std::vector<cl_mem> buffers_;
};

inline Aabb aabb_of(const oibvh::Box& box)
{
    return {box.min_x, box.min_y, box.min_z, box.max_x, box.max_y, box.max_z};
}

/// A mesh in the library's types.
struct LibraryMesh {
    std::vector<oibvh::Point> points;
    std::vector<oibvh::Face> faces;

    oibvh::HostTriangles on_host() const { return {points, faces}; }
    oibvh::DeviceTriangles on_device(Caller& caller) const
    {
        return {caller.buffer_of(points), points.size(), caller.buffer_of(faces), faces.size()};
    }

    /// Returns the mesh in the internal types.
    Mesh mesh() const
    {
        Mesh mesh;
        for (const oibvh::Point point : points)
            mesh.points.push_back({point.x, point.y, point.z});
        for (const oibvh::Face face : faces)
            mesh.faces.push_back({face.a, face.b, face.c});
        return mesh;
    }

    std::vector<oibvh::Box> boxes() const
    {
        std::vector<oibvh::Box> boxes;
        const Mesh own = mesh();
        for (const Aabb box : face_boxes(own.points, own.faces))
            boxes.push_back({box.min_x, box.min_y, box.min_z, box.max_x, box.max_y, box.max_z});
        return boxes;
    }
};

inline LibraryMesh scene_mesh(const std::string& name)
{
    const Scene scene = load_scene(name, {});
    LibraryMesh mesh;
    for (const Point point : scene.frames.front())
        mesh.points.push_back({point.x, point.y, point.z});
    for (const Face face : scene.faces)
        mesh.faces.push_back({face.a, face.b, face.c});
    return mesh;
}

/// Returns `count` random triangles in the unit cube, each about as large as the distance to its neighbours.
inline LibraryMesh soup_mesh(std::size_t count, unsigned seed = 1)
{
    std::mt19937 random(seed);
    const float size = 1 / std::max(1.0f, std::cbrt(static_cast<float>(count)));
    const auto next = [&] { return static_cast<float>(random() >> 8) / 16777216.0f; };
    LibraryMesh mesh;
    for (std::uint32_t k = 0; k < count; ++k) {
        const oibvh::Point at = {next(), next(), next()};
        for (int corner = 0; corner < 3; ++corner)
            mesh.points.push_back(
                {at.x + size * next(), at.y + size * next(), at.z + size * next()});
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

/// Returns the pairs as a PairList, the sweep oracle's type. Expects no pair to occur twice.
inline PairList pair_list(const std::vector<oibvh::Pair>& pairs)
{
    std::vector<Pair> own;
    for (const oibvh::Pair pair : pairs)
        own.push_back({pair.a, pair.b});
    PairList list(std::move(own));
    EXPECT_EQ(list.surplus(), 0u);
    return list;
}

inline PairList swept_pairs(const LibraryMesh& mesh, bool keep_adjacent = true)
{
    const Mesh own = mesh.mesh();
    return touching_pairs(own.points, own.faces, keep_adjacent);
}

/// What a query is asked for, in the types of the library and of the oracle.
inline constexpr std::pair<oibvh::Among, Among> amongs[] = {
    {oibvh::Among::all, Among::all},
    {oibvh::Among::between_objects, Among::between_objects},
    {oibvh::Among::within_objects, Among::within_objects}};

/// Three overlapping triangle soups of 1, 300 and 77 triangles.
struct ThreeObjects {
    std::vector<std::uint32_t> sizes = {1, 300, 77};
    std::vector<LibraryMesh> parts;  ///< each alone
    LibraryMesh mesh;

    ThreeObjects()
    {
        for (const std::uint32_t size : sizes) {
            const LibraryMesh& own = parts.emplace_back(soup_mesh(size, size));
            for (const oibvh::Face face : own.faces) {
                const auto shift = static_cast<std::uint32_t>(mesh.points.size());
                mesh.faces.push_back({face.a + shift, face.b + shift, face.c + shift});
            }
            mesh.points.insert(mesh.points.end(), own.points.begin(), own.points.end());
        }
    }

    std::vector<FaceRange> ranges() const { return {{0, 1}, {1, 300}, {301, 77}}; }
    void move(std::size_t object, float by)
    {
        const FaceRange range = ranges()[object];
        for (std::size_t k = 3 * range.first; k < 3 * (std::size_t{range.first} + range.count); ++k)
            mesh.points[k].x += by * static_cast<float>(k % 7);
    }
    PairList right(Among among) const { return among_objects(swept_pairs(mesh), ranges(), among); }
};

/// Returns the pairs of a tree's last query. Expects the host's count, the device's count and both lists of pairs to agree.
inline PairList listed(const oibvh::Tree& tree, const Caller& caller, const oibvh::Pairs& found)
{
    const auto counts = caller.values_of<cl_uint>(found.device_count, 2);
    EXPECT_EQ(counts[0] | std::uint64_t{counts[1]} << 32, found.count);
    const std::vector<oibvh::Pair> pairs = tree.read_pairs();
    EXPECT_EQ(pairs.size(), found.count);
    EXPECT_EQ(pairs, caller.values_of<oibvh::Pair>(found.pairs, pairs.size()));
    return pair_list(pairs);
}

inline PairList found_pairs(oibvh::Tree& tree, const Caller& caller,
                            oibvh::Among among = oibvh::Among::all)
{
    return listed(tree, caller, tree.find_pairs(among));
}

class OfACaller : public testing::Test {
protected:
    Caller caller;
    oibvh::Device device{caller.queue};
};

}  // namespace bvhbench
