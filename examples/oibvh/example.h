// SPDX-License-Identifier: MIT
//
// What both examples need besides the library: a queue, and a torus to build over.
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <bvhbench/oibvh.h>

namespace example {

inline void check(cl_int code, const char* call)
{
    if (code != CL_SUCCESS)
        throw std::runtime_error(std::string(call) + " failed with " + std::to_string(code));
}

/// The first device of the first platform that has one, its context, and a queue as a program may have it.
struct OpenCl {
    cl_device_id device = nullptr;
    cl_context context = nullptr;
    cl_command_queue queue = nullptr;

    OpenCl()
    {
        cl_uint platform_count = 0;
        clGetPlatformIDs(0, nullptr, &platform_count);
        std::vector<cl_platform_id> platforms(platform_count);
        if (platform_count > 0)
            check(clGetPlatformIDs(platform_count, platforms.data(), nullptr), "clGetPlatformIDs");
        for (const cl_platform_id platform : platforms)
            if (device == nullptr)
                clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr);
        if (device == nullptr)
            throw std::runtime_error("there is no OpenCL device");
        cl_int code = CL_SUCCESS;
        context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, &code);
        check(code, "clCreateContext");
        queue = clCreateCommandQueue(context, device, CL_QUEUE_PROFILING_ENABLE, &code);
        check(code, "clCreateCommandQueue");
    }
    OpenCl(const OpenCl&) = delete;
    OpenCl& operator=(const OpenCl&) = delete;
    ~OpenCl()
    {
        if (queue != nullptr)
            clReleaseCommandQueue(queue);
        if (context != nullptr)
            clReleaseContext(context);
    }
};

struct Mesh {
    std::vector<bvhbench::oibvh::Point> points;
    std::vector<bvhbench::oibvh::Face> faces;
};

/// 2 * around * along triangles: a tube of radius 1 around a circle of radius 3.
inline Mesh torus(std::uint32_t around, std::uint32_t along)
{
    constexpr float turn = 6.2831853f;
    Mesh mesh;
    for (std::uint32_t u = 0; u < around; ++u)
        for (std::uint32_t v = 0; v < along; ++v) {
            const float a = turn * static_cast<float>(u) / static_cast<float>(around);
            const float b = turn * static_cast<float>(v) / static_cast<float>(along);
            const float radius = 3 + std::cos(b);
            mesh.points.push_back({radius * std::cos(a), radius * std::sin(a), std::sin(b)});
            const std::uint32_t next_u = (u + 1) % around, next_v = (v + 1) % along;
            const std::uint32_t corners[] = {u * along + v, next_u * along + v,
                                             next_u * along + next_v, u * along + next_v};
            mesh.faces.push_back({corners[0], corners[1], corners[2]});
            mesh.faces.push_back({corners[0], corners[2], corners[3]});
        }
    return mesh;
}

inline bvhbench::oibvh::Box box_of(const Mesh& mesh, bvhbench::oibvh::Face face)
{
    const auto a = mesh.points[face.a], b = mesh.points[face.b], c = mesh.points[face.c];
    return {std::fmin(std::fmin(a.x, b.x), c.x), std::fmin(std::fmin(a.y, b.y), c.y),
            std::fmin(std::fmin(a.z, b.z), c.z), std::fmax(std::fmax(a.x, b.x), c.x),
            std::fmax(std::fmax(a.y, b.y), c.y), std::fmax(std::fmax(a.z, b.z), c.z)};
}

}  // namespace example
