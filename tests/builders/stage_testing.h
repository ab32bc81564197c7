// SPDX-License-Identifier: MIT
//
// Shared by the tests of stages: a device, meshes that are difficult for boxes and codes, and comparison bit for bit.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <random>
#include <vector>

#include "builders/builder.h"
#include "builders/host_tree.h"
#include "builders/input.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/mesh.h"
#include "tests/all_cases.h"
#include "tests/case_name.h"

namespace bvhbench {

/// A device with its queue and programs, which are compiled once for all tests of an executable.
struct Bench {
    Device device = open_device("");
    Programs programs{device};
    Queue queue{device};
};

inline Bench& bench()
{
    // Never destroyed, because statics are destroyed after the driver has been unloaded.
    static Bench& bench = *new Bench;
    return bench;
}

/// Returns programs of the same device with other parameters.
inline Programs& programs_tuned(
    std::initializer_list<std::pair<const Parameter*, unsigned>> parameters)
{
    Device& device = *new Device(bench().device);  // never destroyed, like bench()
    for (const auto& [parameter, value] : parameters)
        device.tuning.set(*parameter, value);
    return *new Programs(device);
}

/// Reserves exactly what `take` takes of an arena: measures first, as builders do.
template <class Take>
void reserve(const Take& take)
{
    Arena measuring = Arena::measuring(bench().device);
    take(measuring);
    Arena arena = Arena::reserved(bench().device, measuring.used());
    take(arena);
}

/// Returns a new buffer with these values on the device.
template <class T>
Buffer<T> on_device(const std::vector<T>& values)
{
    Arena arena = Arena::reserved(bench().device, {values.size() * sizeof(T), 0});
    Buffer<T> buffer = arena.take<T>(values.size(), Use::tree);
    buffer.upload(bench().queue.cl(), values);
    return buffer;
}

template <class T>
std::vector<T> from_device(const Buffer<T>& buffer)
{
    return buffer.download(bench().queue.cl());
}

/// Returns 0, 1, 2, ... in random order.
inline std::vector<uint> shuffled_ids(std::size_t count)
{
    std::vector<uint> ids(count);
    std::iota(ids.begin(), ids.end(), 0u);
    std::shuffle(ids.begin(), ids.end(), std::mt19937(3));
    return ids;
}

inline bool same_bits(const Aabb& a, const Aabb& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Expects one tree from all builds over sorted leaves: 20 by day, 100 at night.
inline void expect_one_tree(Builder& builder, const Mesh& mesh)
{
    const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
    builder.reserve(mesh.faces.size());
    const Tree& tree = builder.build(input, bench().queue);
    const std::uint64_t first = tree_hash(tree.to_host_tree());
    for (int repeat = 0; repeat < (takes_all_cases() ? 100 : 20); ++repeat) {
        builder.build(input, bench().queue, Start::from_sorted_leaves);
        ASSERT_EQ(tree_hash(tree.to_host_tree()), first);
    }
    bench().queue.finish();
}

/// Both forms of kernels, for tests that run both on any device.
constexpr KernelForm both_forms[] = {KernelForm::groups, KernelForm::chunks};

struct NamedMesh {
    std::string name;
    Mesh mesh;
};

/// Returns `count` small triangles with corners from [-1, 1); `map` is applied to each coordinate.
template <class Map = std::identity>
Mesh random_mesh(std::size_t count, const Map& map = {}, uint seed = 7)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> anywhere(-1.0f, 1.0f);
    std::uniform_real_distribution<float> near(-0.01f, 0.01f);
    Mesh mesh;
    for (uint k = 0; k < count; ++k) {
        const Point at = {anywhere(random), anywhere(random), anywhere(random)};
        for (int corner = 0; corner < 3; ++corner)
            mesh.points.push_back(
                map(Point{at.x + near(random), at.y + near(random), at.z + near(random)}));
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

inline auto scaled(float by)
{
    return [by](Point p) { return Point{p.x * by, p.y * by, p.z * by}; };
}

/// Returns meshes of `count` triangles on which careless arithmetic overflows, divides by zero or loses all bits.
inline std::vector<NamedMesh> hard_meshes(std::size_t count)
{
    std::vector<NamedMesh> meshes;
    meshes.push_back({"plain", random_mesh(count, scaled(1.0f))});
    meshes.push_back({"one point", random_mesh(count, scaled(0.0f))});
    meshes.push_back({"one place", random_mesh(count, [](Point) {
                          return Point{0.3f, -0.7f, 1e-3f};
                      })});
    meshes.push_back({"flat", random_mesh(count, [](Point p) { return Point{p.x, 5.0f, p.z}; })});
    meshes.push_back({"line", random_mesh(count, [](Point p) { return Point{0.0f, 0.0f, p.z}; })});
    meshes.push_back({"denormal", random_mesh(count, scaled(1e-41f))});
    meshes.push_back({"few denormals", random_mesh(count, scaled(6e-45f))});
    meshes.push_back({"half the floats", random_mesh(count, scaled(1.65e38f))});
    meshes.push_back({"all the floats", random_mesh(count, scaled(3.3e38f))});
    meshes.push_back({"far away", random_mesh(count, [](Point p) {
                          return Point{p.x + 1e6f, p.y - 1e6f, p.z + 1e6f};
                      })});
    meshes.push_back({"negative zeros", random_mesh(count, [](Point p) {
                          return Point{p.x < 0 ? -0.0f : 0.0f, p.y < 0.5f ? -0.0f : p.y, p.z};
                      })});
    meshes.push_back({"outlier", random_mesh(count, scaled(1.0f))});
    meshes.back().mesh.points.front() = {1e30f, -1e20f, 3e10f};
    return meshes;
}

}  // namespace bvhbench
