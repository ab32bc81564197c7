// SPDX-License-Identifier: MIT
//
// A kernel of the caller's own that walks the tree where it stands: how many triangles' boxes does each of some points lie
// in? Holds the counts to brute force: exits 1 if they differ, 3 if there is no device.
#include <cstdio>
#include <exception>

#include "example.h"

namespace oibvh = bvhbench::oibvh;

namespace {

// The tree's own functions come before it: Tree::kernel_text().
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

/// Compile it behind the tree's functions. The kernel, which the caller releases.
cl_kernel compiled(const example::OpenCl& opencl, const std::string& text)
{
    const char* source = text.c_str();
    cl_int code = CL_SUCCESS;
    const cl_program program =
        clCreateProgramWithSource(opencl.context, 1, &source, nullptr, &code);
    example::check(code, "clCreateProgramWithSource");
    code = clBuildProgram(program, 1, &opencl.device, "-cl-std=CL1.2", nullptr, nullptr);
    const cl_kernel kernel =
        code == CL_SUCCESS ? clCreateKernel(program, "count_boxes", &code) : nullptr;
    clReleaseProgram(program);
    example::check(code, "compiling count_boxes");
    return kernel;
}

std::vector<cl_uint> counted(const example::OpenCl& opencl, const oibvh::Tree& tree,
                             const std::vector<oibvh::Point>& points)
{
    const oibvh::Buffers buffers = tree.buffers();
    const cl_kernel kernel = compiled(opencl, tree.kernel_text() + count_boxes);
    const cl_mem at = clCreateBuffer(opencl.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                                     points.size() * sizeof points[0],
                                     const_cast<oibvh::Point*>(points.data()), nullptr);
    const cl_mem counts = clCreateBuffer(opencl.context, CL_MEM_WRITE_ONLY,
                                         points.size() * sizeof(cl_uint), nullptr, nullptr);
    cl_uint index = 0;
    for (const cl_mem* buffer :
         {&buffers.nodes, &buffers.leaf_boxes, &buffers.ids, &buffers.objects, &at, &counts})
        example::check(clSetKernelArg(kernel, index++, sizeof(cl_mem), buffer), "clSetKernelArg");
    const std::size_t items = points.size();
    example::check(clEnqueueNDRangeKernel(opencl.queue, kernel, 1, nullptr, &items, nullptr, 0,
                                          nullptr, nullptr),
                   "clEnqueueNDRangeKernel");
    std::vector<cl_uint> found(points.size());
    example::check(
        clEnqueueReadBuffer(opencl.queue, counts, CL_TRUE, 0, found.size() * sizeof(cl_uint),
                            found.data(), 0, nullptr, nullptr),
        "clEnqueueReadBuffer");
    clReleaseMemObject(at);
    clReleaseMemObject(counts);
    clReleaseKernel(kernel);
    return found;
}

int run()
{
    const example::OpenCl opencl;
    const example::Mesh mesh = example::torus(60, 40);
    oibvh::Tree tree(opencl.queue);
    tree.build(oibvh::HostTriangles{mesh.points, mesh.faces});

    const std::vector<cl_uint> found = counted(opencl, tree, mesh.points);
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

int main()
{
    try {
        return run();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "own_kernel: %s\n", error.what());
        return 3;
    }
}
