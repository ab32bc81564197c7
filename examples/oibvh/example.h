// SPDX-License-Identifier: MIT
//
// Code shared by both examples: an OpenCL queue and a torus.
#pragma once

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <bvhbench/oibvh.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace example {

/// Returns a queue on the first device of the first platform that has one.
inline cl::CommandQueue first_queue()
{
    std::vector<cl::Platform> platforms;
    std::vector<cl::Device> devices;
    cl::Platform::get(&platforms);
    for (std::size_t k = 0; k < platforms.size() && devices.empty(); ++k)
        platforms[k].getDevices(CL_DEVICE_TYPE_ALL, &devices);
    if (devices.empty())
        throw std::runtime_error("there is no OpenCL device");
    return {cl::Context(devices.front()), devices.front(), CL_QUEUE_PROFILING_ENABLE};
}

/// Runs `run` and prints the message of any exception. Returns the exit code, 3 after an exception.
inline int run_example(const char* name, int (*run)())
{
    try {
        return run();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return 3;
    }
}

struct Mesh {
    std::vector<bvhbench::oibvh::Point> points;
    std::vector<bvhbench::oibvh::Face> faces;
};

/// Returns a torus of 2 * around * along triangles: a tube of radius 1 around a circle of radius 3.
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
