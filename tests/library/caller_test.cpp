// SPDX-License-Identifier: MIT
//
// The library leaves the caller's queue of any kind, memory, OpenCL objects and environment as they were.
#include <cstdlib>
#include <cstring>
#include <map>

#include "tests/library/testing.h"

extern char** environ;

namespace bvhbench {
namespace {

constexpr cl_command_queue_properties kinds_of_queue[] = {
    0, CL_QUEUE_PROFILING_ENABLE, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE,
    CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE | CL_QUEUE_PROFILING_ENABLE};

/// Kernel text: moves all points by (x, 0, 0), slowly, so that a library call that does not wait for it reads old points.
constexpr const char* slow_move = R"(
kernel void slow_move(global float* points, const uint count, const float x)
{
    for (uint round = 0; round < 2000; ++round)
        for (uint k = 0; k < count; ++k)
            points[3 * k] += round % 2 == 0 ? x : -x;
    for (uint k = 0; k < count; ++k)
        points[3 * k] += x;
})";

/// Enqueues `slow_move` on the caller's queue. Does not wait.
void move_slowly(const Caller& caller, cl_mem points, std::size_t count, float x)
{
    cl::Kernel kernel(cl::Program(cl::Context(caller.context, true), slow_move, true), "slow_move");
    kernel.setArg(0, cl::Buffer(points, true));
    kernel.setArg(1, static_cast<cl_uint>(count));
    kernel.setArg(2, x);
    cl::CommandQueue(caller.queue, true)
        .enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
}

class LibraryCaller : public OfACaller {};

TEST(LibraryQueues, MayHaveAnyQueue)
{
    for (const cl_command_queue_properties kind : kinds_of_queue) {
        Caller caller(kind);
        ASSERT_NE(caller.queue, nullptr);
        oibvh::Tree tree(caller.queue);
        for (const std::size_t size : {1, 3, 700}) {
            const LibraryMesh mesh = soup_mesh(size);
            tree.build(mesh.on_host());
            EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh)) << kind << ' ' << size;
            tree.refit(mesh.on_device(caller));
            EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh)) << kind << ' ' << size;
        }
    }
}

TEST(LibraryQueues, FindsCallsWhereHePutThemAmongHisCommands)
{
    for (const cl_command_queue_properties kind : kinds_of_queue) {
        Caller caller(kind);
        const oibvh::Device device(caller.queue);
        oibvh::Tree tree(device, {.check_input = false}), other(device, {.check_input = false});
        LibraryMesh mesh = soup_mesh(500), moved = mesh;
        const oibvh::DeviceTriangles triangles = mesh.on_device(caller);
        tree.build(triangles);  // allocates
        move_slowly(caller, triangles.points, mesh.points.size(), 1);
        tree.build(triangles);                                         // must see the first move
        move_slowly(caller, triangles.points, mesh.points.size(), 1);  // and not this one
        for (oibvh::Point& point : moved.points)
            point.x += 1;
        other.build(moved.on_host());
        const oibvh::HostTree read = tree.read(), right = other.read();
        EXPECT_EQ(read.ids, right.ids) << kind;
        EXPECT_EQ(std::memcmp(read.nodes.data(), right.nodes.data(),
                              right.nodes.size() * sizeof(oibvh::Box)),
                  0)
            << kind;
    }
}

TEST(LibraryQueues, GetsTimesFromAQueueThatHasThem)
{
    for (const cl_command_queue_properties kind : kinds_of_queue) {
        Caller caller(kind);
        oibvh::Device device(caller.queue);
        oibvh::Tree tree(device, {.order = "morton30"});
        const LibraryMesh mesh = soup_mesh(5000);
        tree.build(mesh.on_host());
        std::map<std::string, oibvh::Stage> stages;
        for (const oibvh::Stage& stage : device.times())
            stages[stage.name] = stage;
        if ((kind & CL_QUEUE_PROFILING_ENABLE) == 0) {
            EXPECT_TRUE(stages.empty());
            continue;
        }
        std::vector<const char*> names = {"check", "hierarchy"};
        if (stages.contains("order"))  // some GPUs order in one launch, and the hierarchy gathers
            names.push_back("order");
        else
            names.insert(names.end(), {"bounds", "codes", "sort", "gather"});
        for (const char* name : names) {
            EXPECT_GT(stages[name].launches, 0) << name;
            EXPECT_GT(stages[name].span_ns, 0) << name;
            EXPECT_GE(stages[name].span_ns, stages[name].busy_ns) << name;
        }
        tree.find_pairs();
        const std::vector<oibvh::Stage> query = device.times();
        ASSERT_EQ(query.size(), 1u);
        EXPECT_EQ(query[0].name, "broad");
    }
}

TEST_F(LibraryCaller, PaysForMemoryOnceASize)
{
    oibvh::Tree tree(device);
    const LibraryMesh first = soup_mesh(700, 1), second = soup_mesh(700, 2), small = soup_mesh(20);
    tree.build(first.on_host());
    tree.find_pairs();
    const oibvh::Buffers before = tree.buffers();
    const std::size_t taken = device.memory();
    EXPECT_EQ(tree.memory(), taken);
    for (int time = 0; time < 3; ++time)
        for (const LibraryMesh* mesh : {&second, &first}) {
            tree.build(mesh->on_host());
            EXPECT_EQ(found_pairs(tree, caller), swept_pairs(*mesh));
            EXPECT_EQ(tree.buffers().nodes, before.nodes);
            EXPECT_EQ(device.memory(), taken);
        }
    tree.build(first.on_device(caller));  // frees the copies of host arrays
    EXPECT_EQ(device.memory() + 12 * (first.points.size() + first.faces.size()), taken);
    tree.build(small.on_host());
    EXPECT_LT(device.memory(), taken);
    {
        oibvh::Tree other(device);
        other.build(first.on_host());
        EXPECT_EQ(device.memory(), tree.memory() + other.memory());
        EXPECT_GT(other.memory(), tree.memory());
    }
    tree = oibvh::Tree(device);
    EXPECT_EQ(device.memory(), 0u);
}

TEST_F(LibraryCaller, MayHaveManyTreesAtATime)
{
    std::vector<oibvh::Tree> trees;
    std::vector<LibraryMesh> meshes;
    for (unsigned k = 0; k < 6; ++k) {
        if (k % 2 == 0)
            trees.emplace_back(device);
        else
            trees.emplace_back(caller.queue);  // has its own Device and kernels
        meshes.push_back(soup_mesh(100 + 50 * k, k));
        trees.back().build(meshes.back().on_host());
    }
    for (unsigned k = 0; k < 6; ++k)
        EXPECT_EQ(found_pairs(trees[k], caller), swept_pairs(meshes[k]));
    trees.erase(trees.begin());  // moves the others
    EXPECT_EQ(found_pairs(trees[0], caller), swept_pairs(meshes[1]));

    const double compiled = device.compile_seconds();
    EXPECT_GT(compiled, 0);
    oibvh::Tree another(device);
    another.build(meshes[0].on_host());
    another.find_pairs();
    EXPECT_EQ(device.compile_seconds(), compiled);  // once per Device
}

TEST(LibraryQueues, MayUseTreesOfADeviceFromSeveralThreads)
{
    Caller caller(CL_QUEUE_PROFILING_ENABLE);  // so that all threads record stages
    const oibvh::Device device(caller.queue);
    const auto work = [&](unsigned seed, bool& is_right) {
        const LibraryMesh mesh = soup_mesh(20 + seed, seed);
        const PairList right = swept_pairs(mesh);
        for (int time = 0; time < 25; ++time) {
            oibvh::Tree tree(device);
            for (int again = 0; again < 4; ++again) {
                tree.build(mesh.on_host());
                tree.find_pairs();
                is_right = is_right && pair_list(tree.read_pairs()) == right;
            }
        }
    };
    bool is_right[] = {true, true, true};
    std::thread first(work, 1u, std::ref(is_right[0])), second(work, 2u, std::ref(is_right[1]));
    work(3, is_right[2]);
    first.join();
    second.join();
    for (const bool right : is_right)
        EXPECT_TRUE(right);
    EXPECT_EQ(device.memory(), 0u);
}

/// Returns the caller's reference counts once they equal `expected`, or after `most` looks. First reads every buffer, because
/// PoCL keeps a queue alive for the last event of each buffer, and releases other events shortly after they finish.
cl_uint references_after(const Caller& caller, cl_uint expected, int most)
{
    for (const cl_mem buffer : caller.buffers())
        caller.values_of<char>(buffer, 1);
    clFinish(caller.queue);
    for (int look = 0; look < most && caller.references() != expected; ++look)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return caller.references();
}

TEST_F(LibraryCaller, GetsEveryReferenceBack)
{
    const LibraryMesh mesh = soup_mesh(300), other = soup_mesh(77);
    const oibvh::DeviceTriangles first = mesh.on_device(caller), second = other.on_device(caller);
    const std::vector<oibvh::Box> boxes = mesh.boxes();
    const oibvh::DeviceBoxes third{caller.buffer_of(boxes), boxes.size()};
    const cl_uint before = references_after(caller, 1, 200);
    {
        oibvh::Tree tree(caller.queue), besides(caller.queue, {.check_input = false});
        tree.build(first);
        tree.find_pairs();
        tree.build(second);
        tree.find_pairs(tree);
        EXPECT_GT(caller.references(), before);
        EXPECT_THROW(tree.build(oibvh::DeviceTriangles{first.points, 1, first.faces, 300}),
                     oibvh::BadInput);
        tree.build(third);
        besides.build(first);  // destroyed before the build has run
    }
    EXPECT_EQ(references_after(caller, before, 10'000), before);
}

TEST_F(LibraryCaller, KeepsHisEnvironment)
{
    const auto variables = [] {
        std::vector<std::string> all;
        for (char** word = environ; *word != nullptr; ++word)
            all.emplace_back(*word);
        return all;
    };
    setenv("BVHBENCH_KERNELS", "/nowhere", 1);  // the program reads kernels from here
    setenv("BVHBENCH_TUNING", "/nowhere", 1);
    const std::vector<std::string> before = variables();
    {
        oibvh::Tree tree(caller.queue);
        tree.build(soup_mesh(100).on_host());
        tree.find_pairs();
    }
    EXPECT_EQ(variables(), before);
    unsetenv("BVHBENCH_KERNELS");
    unsetenv("BVHBENCH_TUNING");
}

/// CMakeLists.txt runs this test a second time with two PoCL devices.
TEST(LibraryQueues, MayHaveAContextOfTwoDevices)
{
    std::vector<cl::Device> devices;
    cl::Platform(open_device("").cl.getInfo<CL_DEVICE_PLATFORM>())
        .getDevices(CL_DEVICE_TYPE_ALL, &devices);
    if (devices.size() < 2)
        GTEST_SKIP() << "there is one device";
    for (const std::vector<cl_device_id>& order :
         {std::vector{devices[0](), devices[1]()}, std::vector{devices[1](), devices[0]()}}) {
        Caller caller(0, order);  // its queue is on the last device
        const LibraryMesh mesh = soup_mesh(700);
        oibvh::Tree tree(caller.queue);
        tree.build(mesh.on_device(caller));
        EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
    }
}

}  // namespace
}  // namespace bvhbench
