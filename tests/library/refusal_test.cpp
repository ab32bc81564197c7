// SPDX-License-Identifier: MIT
//
// What cannot be is refused in one sentence that says what was asked and what there is, and the tree is as good as before.
#include <cmath>
#include <limits>

#include "tests/library/testing.h"

namespace bvhbench {
namespace {

using oibvh::BadInput;

/// What a build over the input throws; and that the next one, over what can be, goes well.
class Refused {
public:
    Caller caller, stranger;
    oibvh::Tree tree{caller.queue};
    LibraryMesh mesh = soup_mesh(300);

    std::string build(const oibvh::Input& input, std::vector<std::uint32_t> objects = {})
    {
        std::string why = sentence<BadInput>([&] { tree.build(input, objects); });
        EXPECT_FALSE(tree.is_built());
        EXPECT_THROW(tree.find_pairs(), BadInput);
        tree.build(mesh.on_host());
        EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
        return why;
    }
};

TEST(LibraryRefuses, AnInputOfNothing)
{
    Refused refused;
    EXPECT_EQ(refused.build(oibvh::HostTriangles{}),
              "there are no triangles, and a tree has a leaf at least");
    EXPECT_EQ(refused.build(oibvh::HostTriangles{{}, refused.mesh.faces}),
              "there are no points, and a tree has a leaf at least");
    EXPECT_EQ(refused.build(oibvh::HostBoxes{}),
              "there are no boxes, and a tree has a leaf at least");
    EXPECT_EQ(refused.build(oibvh::DeviceTriangles{}),
              "there are no triangles, and a tree has a leaf at least");
    EXPECT_EQ(refused.build(oibvh::DeviceBoxes{}),
              "there are no boxes, and a tree has a leaf at least");
}

TEST(LibraryRefuses, MoreThanATreeHolds)
{
    Refused refused;
    const cl_mem any = refused.caller.buffer_of(refused.mesh.points);
    EXPECT_EQ(refused.build(oibvh::DeviceBoxes{any, (std::size_t{1} << 31) + 1}),
              "there are 2147483649 boxes, and a tree has 2147483648 leaves at most");
}

TEST(LibraryRefuses, APointThatIsNotThere)
{
    Refused refused;
    LibraryMesh bad = refused.mesh;
    for (std::uint32_t oibvh::Face::*corner : {&oibvh::Face::a, &oibvh::Face::b, &oibvh::Face::c}) {
        bad.faces[17] = {1, 2, 3};
        bad.faces[17].*corner = 900;
        const std::string why = "triangle 17 names point 900, and there are 900";
        EXPECT_EQ(refused.build(bad.on_host()), why);
        EXPECT_EQ(refused.build(bad.on_device(refused.caller)), why);
    }
    bad.faces[16].a = 4000000000u;  // the first is told
    EXPECT_EQ(refused.build(bad.on_host()),
              "triangle 16 names point 4000000000, and there are 900");
}

TEST(LibraryRefuses, CoordinatesThatAreNotFinite)
{
    Refused refused;
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          -std::numeric_limits<float>::infinity()})
        for (float oibvh::Point::*axis : {&oibvh::Point::x, &oibvh::Point::y, &oibvh::Point::z}) {
            LibraryMesh bad = refused.mesh;
            bad.points[3 * 42 + 1].*axis = value;
            const std::string why = refused.build(bad.on_device(refused.caller));
            EXPECT_EQ(why.substr(0, 50),
                      "triangle 42 has a corner that is not finite: (" + why.substr(46, 4));
            EXPECT_NE(why.find(std::isnan(value) ? "nan" : "inf"), std::string::npos) << why;
            const std::vector<oibvh::Box> boxes = {{0, 0, 0, 1, 1, 1}, {0, 0, 0, 1, value, 1}};
            EXPECT_NE(refused.build(oibvh::HostBoxes{boxes}).find("box 1 has a corner"),
                      std::string::npos);
        }
    LibraryMesh unused = refused.mesh;  // what no triangle names does not matter
    unused.points.push_back({std::nanf(""), 0, 0});
    refused.tree.build(unused.on_host());
    EXPECT_EQ(found_pairs(refused.tree, refused.caller), swept_pairs(refused.mesh));
}

TEST(LibraryRefuses, ABoxThatEndsBeforeItBegins)
{
    Refused refused;
    const std::vector<oibvh::Box> boxes = {{0, 0, 0, 1, 1, 1}, {0, 2, 0, 1, 1, 1}};
    EXPECT_EQ(refused.build(oibvh::HostBoxes{boxes}),
              "box 1 ends before it begins: from (0.000000, 2.000000, 0.000000) to (1.000000, "
              "1.000000, 1.000000)");
}

TEST(LibraryRefuses, WhatIsWrongInABufferThatTheHostMayNotRead)
{
    Refused refused;
    std::vector<oibvh::Box> boxes = {{0, 0, 0, 1, 1, 1}, {0, 2, 0, 1, 1, 1}};
    const cl_mem unread =
        clCreateBuffer(refused.caller.context, CL_MEM_HOST_NO_ACCESS | CL_MEM_COPY_HOST_PTR,
                       boxes.size() * sizeof(oibvh::Box), boxes.data(), nullptr);
    EXPECT_EQ(
        refused.build(oibvh::DeviceBoxes{unread, 2}),
        "a box has a corner that is not finite, or ends before it begins; which one cannot be "
        "told, since the host may not read the buffer");
    clReleaseMemObject(unread);
}

TEST(LibraryRefuses, ABufferThatIsTooShort)
{
    Refused refused;
    const oibvh::DeviceTriangles all = refused.mesh.on_device(refused.caller);
    EXPECT_EQ(refused.build(oibvh::DeviceTriangles{all.points, 901, all.faces, 300}),
              "901 points of 12 bytes do not fit into their buffer of 10800");
    EXPECT_EQ(refused.build(oibvh::DeviceTriangles{all.points, 900, all.faces, 301}),
              "301 faces of 12 bytes do not fit into their buffer of 3600");
    EXPECT_EQ(refused.build(oibvh::DeviceBoxes{all.faces, 151}),
              "151 boxes of 24 bytes do not fit into their buffer of 3600");
}

TEST(LibraryRefuses, ABufferThatIsNotTheQueues)
{
    Refused refused;
    const oibvh::DeviceTriangles own = refused.mesh.on_device(refused.caller);
    const oibvh::DeviceTriangles strange = refused.mesh.on_device(refused.stranger);
    EXPECT_EQ(refused.build(oibvh::DeviceTriangles{strange.points, 900, own.faces, 300}),
              "the buffer of points is of another context than the queue");
    EXPECT_EQ(refused.build(oibvh::DeviceTriangles{own.points, 900, strange.faces, 300}),
              "the buffer of faces is of another context than the queue");
    EXPECT_EQ(refused.build(oibvh::DeviceTriangles{own.points, 900, nullptr, 300}),
              "the buffer of faces is null");
    const cl_mem unread =
        clCreateBuffer(refused.caller.context, CL_MEM_WRITE_ONLY, 7200, nullptr, nullptr);
    EXPECT_EQ(refused.build(oibvh::DeviceBoxes{unread, 300}),
              "the buffer of boxes is write-only to kernels, and they have to read it");
    clReleaseMemObject(unread);
}

TEST(LibraryRefuses, ObjectsThatAreNotTheTriangles)
{
    Refused refused;
    EXPECT_EQ(refused.build(refused.mesh.on_host(), {100, 100}),
              "the objects' sizes come to 200, and there are 300 triangles or boxes");
    EXPECT_EQ(refused.build(refused.mesh.on_host(), {300, 0}),
              "object 1 is empty, and a tree has a leaf at least");
    EXPECT_EQ(refused.build(refused.mesh.on_host(), {300, 4294967295u}),
              "the objects' sizes come to 4294967595, and there are 300 triangles or boxes");
}

TEST(LibraryRefuses, ObjectsOfAnOrderOfOne)
{
    Caller caller;
    oibvh::Tree tree(caller.queue, {.order = "kd"});
    const LibraryMesh mesh = soup_mesh(300);
    const std::vector<std::uint32_t> halves = {150, 150};
    EXPECT_NE(sentence<BadInput>([&] {
                  tree.build(mesh.on_host(), halves);
              }).find("order kd lines up one object, not 2"),
              std::string::npos);
    tree.build(mesh.on_host());
    EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
}

TEST(LibraryRefuses, CallsOutOfTurn)
{
    Caller caller;
    const oibvh::Device device(caller.queue);
    oibvh::Tree tree(device), unbuilt(device), other(caller.queue);
    const LibraryMesh mesh = soup_mesh(30), more = soup_mesh(31);
    const auto without = [](const char* what) {
        return std::string(what) + " needs a tree, and none was built, or its build failed";
    };
    EXPECT_EQ(sentence<BadInput>([&] { tree.find_pairs(); }), without("a query"));
    EXPECT_EQ(sentence<BadInput>([&] { tree.refit(mesh.on_host()); }), without("a refit"));
    EXPECT_EQ(sentence<BadInput>([&] { tree.buffers(); }), without("buffers"));
    EXPECT_EQ(sentence<BadInput>([&] { tree.levels(); }), without("levels"));
    EXPECT_EQ(sentence<BadInput>([&] { tree.read(); }), without("reading"));
    for (int time = 0; time < 2; ++time) {
        tree.build(mesh.on_host());
        EXPECT_EQ(sentence<BadInput>([&] { tree.read_pairs(); }),
                  "there are no pairs to read: nothing was queried since the last build");
        tree.find_pairs();
    }
    EXPECT_EQ(sentence<BadInput>([&] { tree.find_pairs(other); }),
              "a query between trees wants both of one Device");
    EXPECT_EQ(sentence<BadInput>([&] { tree.find_pairs(unbuilt); }),
              without("a query between trees"));
    EXPECT_EQ(sentence<BadInput>([&] { tree.levels(1); }), "there is no object 1, and there are 1");
    const oibvh::Update two[] = {oibvh::Update::keep, oibvh::Update::keep};
    EXPECT_EQ(sentence<BadInput>([&] { tree.update(mesh.on_host(), two); }),
              "there are 2 updates, and 1 objects");
    EXPECT_EQ(sentence<BadInput>([&] { tree.refit(more.on_host()); }),
              "the objects' sizes come to 30, and there are 31 triangles or boxes");
    EXPECT_FALSE(tree.is_built());
}

TEST(LibraryRefuses, TreesThatCannotBeHeldAgainstEachOther)
{
    Caller caller;
    const oibvh::Device device(caller.queue);
    oibvh::Tree a(device), b(device, {.sorted_leaves = false}), c(device);
    const LibraryMesh mesh = soup_mesh(30);
    const std::vector<std::uint32_t> halves = {15, 15};
    a.build(mesh.on_host());
    b.build(mesh.on_host());
    c.build(mesh.on_host(), halves);
    EXPECT_EQ(
        sentence<BadInput>([&] { a.find_pairs(b); }),
        "a query between trees wants both with sorted_leaves or both without, and one has it");
    EXPECT_EQ(sentence<BadInput>([&] { a.find_pairs(c); }),
              "a query between trees wants trees of one object each, and one has 2");
}

TEST(LibraryRefuses, NumbersThatNameNothingToChoose)
{
    Refused refused;
    refused.tree.build(refused.mesh.on_host());
    refused.tree.find_pairs();
    const std::vector<oibvh::Pair> before = refused.tree.read_pairs();
    for (const int other : {-1, 3, 99})
        EXPECT_EQ(
            sentence<BadInput>([&] { refused.tree.find_pairs(static_cast<oibvh::Among>(other)); }),
            "a query is among all, between_objects or within_objects, not " +
                std::to_string(other));
    EXPECT_EQ(refused.tree.read_pairs(), before);
    const oibvh::Update updates[] = {static_cast<oibvh::Update>(77)};
    EXPECT_EQ(sentence<BadInput>([&] { refused.tree.update(refused.mesh.on_host(), updates); }),
              "an update is rebuild, refit or keep, not 77");
    EXPECT_TRUE(refused.tree.is_built());
    EXPECT_EQ(found_pairs(refused.tree, refused.caller), swept_pairs(refused.mesh));
}

TEST(LibraryRefuses, OptionsThatThereAreNot)
{
    Caller caller;
    const oibvh::Device device(caller.queue);
    const auto why = [&](const oibvh::Options& options) {
        return sentence<BadInput>([&] { oibvh::Tree tree(device, options); });
    };
    EXPECT_EQ(why({.builder = "karras"}),
              "no builder of the library is called 'karras'; there are: oibvh-single, oibvh-multi");
    EXPECT_EQ(why({.collider = "grid"}),
              "no collider of the library is called 'grid'; there are: leaf, group, block, bvtt");
    EXPECT_EQ(why({.order = "peano"}).substr(0, 46),
              "no order is called 'peano'; there are: morton3");
}

TEST(LibraryRefuses, QueuesAndTuningThatThereAreNot)
{
    Caller caller;
    EXPECT_EQ(sentence<BadInput>([] { oibvh::Device device(nullptr); }),
              "a Device wants a cl_command_queue, and it is null");
    const auto why = [&](const char* name, unsigned value) {
        return sentence<BadInput>([&] {
            oibvh::Device device(caller.queue, {.tuning = {{name, value}}});
        });
    };
    EXPECT_EQ(why("sort.luck", 1),
              "no tuning parameter is called 'sort.luck'; `bvhbench list tuning` has them");
    EXPECT_EQ(why("sort.keys_per_item", 4),
              "tuning parameter sort.keys_per_item must be odd, not 4");
    const LibraryMesh mesh = soup_mesh(700);
    const oibvh::Device tuned(caller.queue,
                              {.tuning = {{"chunks.per_core", 7}, {"walk.task_leaves", 16}}});
    oibvh::Tree tree(tuned);
    tree.build(mesh.on_host());
    EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
}

TEST(LibraryRefuses, WhatMemoryDoesNotHold)
{
    Caller caller;
    const oibvh::Device device(caller.queue, {.memory_limit = 100000});
    oibvh::Tree tree(device);
    const LibraryMesh small = soup_mesh(300), large = soup_mesh(5000);
    const std::string why = sentence<oibvh::Unavailable>([&] { tree.build(large.on_host()); });
    EXPECT_EQ(why.substr(0, 22), "out of device memory: ");
    EXPECT_NE(why.find("gives 100000"), std::string::npos) << why;
    tree.build(small.on_host());
    EXPECT_EQ(found_pairs(tree, caller), swept_pairs(small));

    LibraryMesh crowded = soup_mesh(1);  // a tree that fits, and pairs that do not
    crowded.faces.resize(300, crowded.faces.front());
    tree.build(crowded.on_host());
    EXPECT_THROW(tree.find_pairs(), oibvh::Unavailable);
    tree.build(small.on_host());
    EXPECT_EQ(found_pairs(tree, caller), swept_pairs(small));
}

}  // namespace
}  // namespace bvhbench
