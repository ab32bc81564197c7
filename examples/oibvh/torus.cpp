// SPDX-License-Identifier: MIT
//
// Builds a tree over a torus, prints its properties, and finds the pairs of triangles whose boxes overlap. Compares the pairs
// with brute force: exits with 1 if they differ, with 3 if there is no device.
#include <algorithm>

#include "example.h"

namespace oibvh = bvhbench::oibvh;

namespace {

bool overlap(const oibvh::Box& a, const oibvh::Box& b)
{
    return a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y &&
           a.min_z <= b.max_z && b.min_z <= a.max_z;
}

std::vector<oibvh::Pair> by_brute_force(const example::Mesh& mesh)
{
    std::vector<oibvh::Box> boxes;
    for (const oibvh::Face face : mesh.faces)
        boxes.push_back(example::box_of(mesh, face));
    std::vector<oibvh::Pair> pairs;
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
        for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
            if (overlap(boxes[a], boxes[b]))
                pairs.push_back({a, b});
    return pairs;
}

int run()
{
    const cl::CommandQueue queue = example::first_queue();
    const example::Mesh mesh = example::torus(60, 40);

    oibvh::Device device(queue());
    oibvh::Tree tree(device);
    tree.build(oibvh::HostTriangles{mesh.points, mesh.faces});

    const oibvh::Buffers buffers = tree.buffers();
    const std::vector<oibvh::Level> levels = tree.levels();
    std::printf("bvhbench %.*s\n", static_cast<int>(bvhbench::oibvh::version().size()),
                bvhbench::oibvh::version().data());
    std::printf("%u leaves on level %zu of %zu, %zu nodes of %zu bytes, by %.*s\n",
                buffers.leaf_count, levels.size() - 1, levels.size(), buffers.node_count,
                sizeof(oibvh::Box), static_cast<int>(tree.builder().size()), tree.builder().data());
    for (const oibvh::Stage& stage : device.times())
        std::printf("  %-9s %8.1f us, %d launches\n", stage.name.c_str(),
                    1e-3 * static_cast<double>(stage.span_ns), stage.launches);

    const oibvh::Pairs found = tree.find_pairs();
    std::vector<oibvh::Pair> pairs = tree.read_pairs();
    std::sort(pairs.begin(), pairs.end());
    const std::vector<oibvh::Pair> right = by_brute_force(mesh);
    std::printf("%llu pairs by %.*s, %zu by brute force: %s\n",
                static_cast<unsigned long long>(found.count),
                static_cast<int>(tree.collider().size()), tree.collider().data(), right.size(),
                pairs == right ? "the same" : "they differ");
    return pairs == right ? 0 : 1;
}

}  // namespace

int main() { return example::run_example("torus", run); }
