// SPDX-License-Identifier: MIT
//
// A user-defined kernel that traverses the tree in place and counts, for each of several points, the triangle boxes that
// contain it. Compares the counts with brute force: exits with 1 if they differ, with 3 if there is no device.
#include "example.h"

namespace oibvh = bvhbench::oibvh;

namespace {

// Tree::kernel_text() is put before this text and defines the functions of the tree.
constexpr const char* count_boxes = R"(
kernel void count_boxes(FOREST_PARAMETERS, global const float* points, global uint* counts)
{
    const size_t k = get_global_id(0);
    const float x = points[3 * k], y = points[3 * k + 1], z = points[3 * k + 2];
    PICK_TREE(0)  // of object 0
    uint count = 0;
    uint node = tree_root(TREE);
    while (node != TREE_NONE) {
        const Aabb box = tree_box(TREE, node);
        const bool is_in = box.min_x <= x && x <= box.max_x && box.min_y <= y && y <= box.max_y &&
                           box.min_z <= z && z <= box.max_z;
        const bool is_leaf = tree_is_leaf(TREE, node);
        count += is_in && is_leaf ? 1 : 0;
        node = is_in && !is_leaf ? tree_left(TREE, node) : tree_next(TREE, node);
    }
    counts[k] = count;
}
)";

std::vector<cl_uint> counted(const cl::CommandQueue& queue, const oibvh::Tree& tree,
                             std::vector<oibvh::Point> points)
{
    const auto context = queue.getInfo<CL_QUEUE_CONTEXT>();
    const cl::Program program(context, tree.kernel_text() + count_boxes);
    program.build("-cl-std=CL1.2");
    cl::Kernel kernel(program, "count_boxes");

    std::vector<cl_uint> found(points.size());
    const cl::Buffer at(context, points.begin(), points.end(), true);
    const cl::Buffer counts(context, CL_MEM_WRITE_ONLY, found.size() * sizeof(cl_uint));
    const oibvh::Buffers buffers = tree.buffers();
    cl_uint index = 0;
    for (const cl_mem buffer :
         {buffers.nodes, buffers.leaf_boxes, buffers.ids, buffers.objects, at(), counts()})
        kernel.setArg(index++, sizeof buffer, &buffer);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(points.size()));
    cl::copy(queue, counts, found.begin(), found.end());
    return found;
}

int run()
{
    const cl::CommandQueue queue = example::first_queue();
    const example::Mesh mesh = example::torus(60, 40);
    oibvh::Tree tree(queue());
    tree.build(oibvh::HostTriangles{mesh.points, mesh.faces});

    const std::vector<cl_uint> found = counted(queue, tree, mesh.points);
    std::size_t all = 0, wrong = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const oibvh::Point point = mesh.points[k];
        cl_uint count = 0;
        for (const oibvh::Face face : mesh.faces) {
            const oibvh::Box box = example::box_of(mesh, face);
            count += box.min_x <= point.x && point.x <= box.max_x && box.min_y <= point.y &&
                     point.y <= box.max_y && box.min_z <= point.z && point.z <= box.max_z;
        }
        all += count;
        wrong += found[k] != count;
    }
    std::printf("%zu points lie in %zu boxes; %zu counts differ from brute force\n", found.size(),
                all, wrong);
    return wrong == 0 ? 0 : 1;
}

}  // namespace

int main() { return example::run_example("own_kernel", run); }
