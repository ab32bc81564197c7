// SPDX-License-Identifier: MIT
//
// Two waving sheets that pass through each other, on as many devices as MPI has ranks. In each frame the ranks find all pairs of
// triangles whose boxes overlap, and those that intersect; rank 0 compares the pairs with those of one device. Exits with 1 if they
// differ, with 3 after an error.
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <bvhbench/oibvh_cluster.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace oibvh = bvhbench::oibvh;

namespace {

/// Returns a queue on a device of its own for each rank of a host; if there are more ranks than devices, they share.
cl::CommandQueue queue_of_rank()
{
    MPI_Comm host = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host);
    int rank_of_host = 0;
    MPI_Comm_rank(host, &rank_of_host);
    MPI_Comm_free(&host);

    std::vector<cl::Platform> platforms;
    std::vector<cl::Device> devices;
    cl::Platform::get(&platforms);
    for (std::size_t k = 0; k < platforms.size() && devices.empty(); ++k)
        platforms[k].getDevices(CL_DEVICE_TYPE_ALL, &devices);
    if (devices.empty())
        throw std::runtime_error("there is no OpenCL device");
    const cl::Device device = devices[static_cast<std::size_t>(rank_of_host) % devices.size()];
    return {cl::Context(device), device};
}

constexpr std::uint32_t side = 60;  // points along a side of a sheet

/// Returns the points of both sheets at a time; the upper one sinks.
std::vector<oibvh::Point> points_at(float time)
{
    std::vector<oibvh::Point> points;
    for (int sheet = 0; sheet < 2; ++sheet)
        for (std::uint32_t u = 0; u < side; ++u)
            for (std::uint32_t v = 0; v < side; ++v) {
                const auto x = static_cast<float>(u), y = static_cast<float>(v);
                const float z = sheet == 0 ? std::sin(0.2f * x) : 1 - time + std::sin(0.3f * y);
                points.push_back({x, y, z});
            }
    return points;
}

std::vector<oibvh::Face> faces_of_sheets()
{
    std::vector<oibvh::Face> faces;
    for (std::uint32_t sheet = 0; sheet < 2; ++sheet)
        for (std::uint32_t u = 0; u + 1 < side; ++u)
            for (std::uint32_t v = 0; v + 1 < side; ++v) {
                const std::uint32_t at = (sheet * side + u) * side + v;
                faces.push_back({at, at + side, at + side + 1});
                faces.push_back({at, at + side + 1, at + 1});
            }
    return faces;
}

bool run()
{
    const cl::CommandQueue queue = queue_of_rank();
    const oibvh::Options options{.adjacent_pairs = false};
    oibvh::DistributedTree tree(MPI_COMM_WORLD, queue(), {.tree = options, .contacts = true});
    const bool is_first = tree.rank() == 0;

    // Rank 0 has the mesh; the others pass nothing.
    std::vector<oibvh::Point> points;
    std::vector<oibvh::Face> faces;
    if (is_first) {
        points = points_at(0);
        faces = faces_of_sheets();
    }
    tree.distribute(oibvh::HostTriangles{points, faces}, 0);

    bool is_right = true;
    for (int frame = 0; frame < 4; ++frame) {
        if (frame > 0) {
            if (is_first)
                points = points_at(0.5f * static_cast<float>(frame));
            tree.update(points);
        }
        const oibvh::FrameCounts counts = tree.find_pairs();
        const std::vector<oibvh::Pair> pairs = tree.gather_pairs();
        if (is_first) {
            oibvh::Tree alone(queue(), options);
            alone.build(oibvh::HostTriangles{points, faces});
            alone.find_pairs();
            std::vector<oibvh::Pair> right = alone.read_pairs();
            std::sort(right.begin(), right.end());
            std::printf("frame %d: %zu pairs on %d ranks, %zu on one device: %s; %llu intersect\n",
                        frame, pairs.size(), tree.ranks(), right.size(),
                        pairs == right ? "the same" : "they differ",
                        static_cast<unsigned long long>(counts.all_contacts));
            is_right = is_right && pairs == right && !pairs.empty();
        }
        if (counts.imbalance > 1.1)
            tree.rebalance();
    }
    return is_right;
}

}  // namespace

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    int code = 3;
    try {
        code = run() ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "sheets: %s\n", error.what());
        MPI_Abort(MPI_COMM_WORLD, code);  // an error of the program's own may be on one rank alone
    }
    MPI_Finalize();
    return code;
}
