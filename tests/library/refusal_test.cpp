// SPDX-License-Identifier: MIT
//
// Invalid arguments are refused with one sentence that names the argument and what is allowed, and the tree stays usable.
#include <limits>

#include "tests/library/testing.h"

namespace bvhbench {
namespace {

using oibvh::BadInput;
using Sizes = std::vector<std::uint32_t>;

class LibraryRefuses : public OfACaller {
protected:
    Caller stranger;
    oibvh::Tree tree{device};
    LibraryMesh mesh = soup_mesh(300);

    /// Returns the message of the BadInput that a build over `input` throws. Expects the next build, over valid input, to work.
    std::string refusal(const oibvh::Input& input, const Sizes& objects = {})
    {
        std::string why = refusal_of<BadInput>([&] { tree.build(input, objects); });
        EXPECT_FALSE(tree.is_built());
        EXPECT_THROW(tree.find_pairs(), BadInput);
        expect_built();
        return why;
    }

    void expect_built()
    {
        tree.build(mesh.on_host());
        EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
    }

    std::string option_refusal(const oibvh::Options& options)
    {
        return refusal_of<BadInput>([&] { oibvh::Tree(device, options); });
    }

    std::string tuning_refusal(const char* name, unsigned value)
    {
        return refusal_of<BadInput>([&] {
            oibvh::Device(caller.queue, {.tuning = {{name, value}}});
        });
    }
};

TEST_F(LibraryRefuses, CountsThatATreeCannotHave)
{
    const auto none_of = [](const std::string& what) {
        return "there are no " + what + ", and a tree has a leaf at least";
    };
    EXPECT_EQ(refusal(oibvh::HostTriangles{}), none_of("triangles"));
    EXPECT_EQ(refusal(oibvh::HostTriangles{{}, mesh.faces}), none_of("points"));
    EXPECT_EQ(refusal(oibvh::HostBoxes{}), none_of("boxes"));
    EXPECT_EQ(refusal(oibvh::DeviceTriangles{}), none_of("triangles"));
    EXPECT_EQ(refusal(oibvh::DeviceBoxes{}), none_of("boxes"));
    const cl_mem any = caller.buffer_of(mesh.points);
    EXPECT_EQ(refusal(oibvh::DeviceBoxes{any, (std::size_t{1} << 31) + 1}),
              "there are 2147483649 boxes, and a tree has 2147483648 leaves at most");
}

TEST_F(LibraryRefuses, APointThatIsNotThere)
{
    LibraryMesh bad = mesh;
    for (std::uint32_t oibvh::Face::*corner : {&oibvh::Face::a, &oibvh::Face::b, &oibvh::Face::c}) {
        bad.faces[17] = {1, 2, 3};
        bad.faces[17].*corner = 900;
        const std::string why = "triangle 17 names point 900, and there are 900";
        EXPECT_EQ(refusal(bad.on_host()), why);
        EXPECT_EQ(refusal(bad.on_device(caller)), why);
    }
    bad.faces[16].a = 4000000000u;  // the error names the first
    EXPECT_EQ(refusal(bad.on_host()), "triangle 16 names point 4000000000, and there are 900");
}

TEST_F(LibraryRefuses, CoordinatesThatAreNotFinite)
{
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          -std::numeric_limits<float>::infinity()})
        for (float oibvh::Point::*axis : {&oibvh::Point::x, &oibvh::Point::y, &oibvh::Point::z}) {
            LibraryMesh bad = mesh;
            bad.points[3 * 42 + 1].*axis = value;
            const std::string why = refusal(bad.on_device(caller));
            EXPECT_EQ(why.substr(0, 46), "triangle 42 has a corner that is not finite: (");
            EXPECT_NE(why.find(std::isnan(value) ? "nan" : "inf"), std::string::npos) << why;
            const std::vector<oibvh::Box> boxes = {{0, 0, 0, 1, 1, 1}, {0, 0, 0, 1, value, 1}};
            EXPECT_NE(refusal(oibvh::HostBoxes{boxes}).find("box 1 has a corner"),
                      std::string::npos);
        }
    LibraryMesh unused = mesh;  // a point of no triangle is not checked
    unused.points.push_back({std::nanf(""), 0, 0});
    tree.build(unused.on_host());
    EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
}

TEST_F(LibraryRefuses, ABoxThatEndsBeforeItBegins)
{
    std::vector<oibvh::Box> boxes = {{0, 0, 0, 1, 1, 1}, {0, 2, 0, 1, 1, 1}};
    EXPECT_EQ(refusal(oibvh::HostBoxes{boxes}),
              "box 1 ends before it begins: from (0.000000, 2.000000, 0.000000) to (1.000000, "
              "1.000000, 1.000000)");
    const cl_mem unread =
        clCreateBuffer(caller.context, CL_MEM_HOST_NO_ACCESS | CL_MEM_COPY_HOST_PTR,
                       boxes.size() * sizeof(oibvh::Box), boxes.data(), nullptr);
    EXPECT_EQ(
        refusal(oibvh::DeviceBoxes{unread, 2}),
        "a box has a corner that is not finite, or ends before it begins; which one cannot be "
        "told, since the host may not read the buffer");
    clReleaseMemObject(unread);
}

TEST_F(LibraryRefuses, ABufferThatIsTooShortOrNotTheQueues)
{
    const oibvh::DeviceTriangles own = mesh.on_device(caller), strange = mesh.on_device(stranger);
    const auto of = [&](cl_mem points, std::size_t point_count, cl_mem faces, std::size_t count) {
        return refusal(oibvh::DeviceTriangles{points, point_count, faces, count});
    };
    EXPECT_EQ(of(own.points, 901, own.faces, 300),
              "901 points of 12 bytes do not fit into their buffer of 10800");
    EXPECT_EQ(of(own.points, 900, own.faces, 301),
              "301 faces of 12 bytes do not fit into their buffer of 3600");
    EXPECT_EQ(refusal(oibvh::DeviceBoxes{own.faces, 151}),
              "151 boxes of 24 bytes do not fit into their buffer of 3600");
    EXPECT_EQ(of(strange.points, 900, own.faces, 300),
              "the buffer of points is of another context than the queue");
    EXPECT_EQ(of(own.points, 900, strange.faces, 300),
              "the buffer of faces is of another context than the queue");
    EXPECT_EQ(of(own.points, 900, nullptr, 300), "the buffer of faces is null");
    const cl_mem unread = clCreateBuffer(caller.context, CL_MEM_WRITE_ONLY, 7200, nullptr, nullptr);
    EXPECT_EQ(refusal(oibvh::DeviceBoxes{unread, 300}),
              "the buffer of boxes is write-only to kernels, and they have to read it");
    clReleaseMemObject(unread);
}

TEST_F(LibraryRefuses, ObjectsThatAreNotTheTriangles)
{
    EXPECT_EQ(refusal(mesh.on_host(), {100, 100}),
              "the objects' sizes come to 200, and there are 300 triangles or boxes");
    EXPECT_EQ(refusal(mesh.on_host(), {300, 0}),
              "object 1 is empty, and a tree has a leaf at least");
    EXPECT_EQ(refusal(mesh.on_host(), {300, 4294967295u}),
              "the objects' sizes come to 4294967595, and there are 300 triangles or boxes");
    tree = oibvh::Tree(device, {.order = "kd"});
    EXPECT_NE(refusal(mesh.on_host(), {150, 150}).find("order kd lines up one object, not 2"),
              std::string::npos);
}

TEST_F(LibraryRefuses, CallsOutOfTurn)
{
    oibvh::Tree unbuilt(device), other(caller.queue);
    const LibraryMesh more = soup_mesh(301);
    const auto without = [](const char* what) {
        return std::string(what) + " needs a tree, and none was built, or its build failed";
    };
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.find_pairs(); }), without("a query"));
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.refit(mesh.on_host()); }), without("a refit"));
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.buffers(); }), without("buffers"));
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.levels(); }), without("levels"));
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.read(); }), without("reading"));
    for (int time = 0; time < 2; ++time) {
        tree.build(mesh.on_host());
        EXPECT_EQ(refusal_of<BadInput>([&] { tree.read_pairs(); }),
                  "there are no pairs to read: nothing was queried since the last build");
        tree.find_pairs();
    }
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.find_pairs(other); }),
              "a query between trees wants both of one Device");
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.find_pairs(unbuilt); }),
              without("a query between trees"));
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.levels(1); }),
              "there is no object 1, and there are 1");
    const oibvh::Update two[] = {oibvh::Update::keep, oibvh::Update::keep};
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.update(mesh.on_host(), two); }),
              "there are 2 updates, and 1 objects");
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.refit(more.on_host()); }),
              "the objects' sizes come to 300, and there are 301 triangles or boxes");
    EXPECT_FALSE(tree.is_built());
}

TEST_F(LibraryRefuses, TreesThatCannotBeHeldAgainstEachOther)
{
    oibvh::Tree unsorted(device, {.sorted_leaves = false}), of_two(device);
    tree.build(mesh.on_host());
    unsorted.build(mesh.on_host());
    of_two.build(mesh.on_host(), Sizes{150, 150});
    EXPECT_EQ(
        refusal_of<BadInput>([&] { tree.find_pairs(unsorted); }),
        "a query between trees wants both with sorted_leaves or both without, and one has it");
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.find_pairs(of_two); }),
              "a query between trees wants trees of one object each, and one has 2");
}

TEST_F(LibraryRefuses, FiltersOfOtherObjects)
{
    const Sizes sizes = {100, 200}, groups = {1}, masks = {1, 2, 3};
    const std::vector<oibvh::Excluded> excluded = {{0, 1}, {2, 0}};
    tree.build(mesh.on_host(), sizes);
    const auto why = [&](const oibvh::Filter& filter) {
        return refusal_of<BadInput>([&] { tree.find_pairs(oibvh::Among::all, filter); });
    };
    EXPECT_EQ(why({.excluded = excluded}), "a filter excludes object 2, and there are 2 objects");
    EXPECT_EQ(why({.groups = groups}), "a filter has 1 groups, and there are 2 objects");
    EXPECT_EQ(why({.masks = masks}), "a filter has 3 masks, and there are 2 objects");
    EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
}

TEST_F(LibraryRefuses, NumbersThatNameNothingToChoose)
{
    tree.build(mesh.on_host());
    tree.find_pairs();
    const std::vector<oibvh::Pair> before = tree.read_pairs();
    for (const int other : {-1, 3, 99})
        EXPECT_EQ(refusal_of<BadInput>([&] { tree.find_pairs(static_cast<oibvh::Among>(other)); }),
                  "a query is among all, between_objects or within_objects, not " +
                      std::to_string(other));
    EXPECT_EQ(tree.read_pairs(), before);
    const oibvh::Update updates[] = {static_cast<oibvh::Update>(77)};
    EXPECT_EQ(refusal_of<BadInput>([&] { tree.update(mesh.on_host(), updates); }),
              "an update is rebuild, refit or keep, not 77");
    EXPECT_TRUE(tree.is_built());
    EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
}

TEST_F(LibraryRefuses, OptionsQueuesAndTuningThatThereAreNot)
{
    EXPECT_EQ(option_refusal({.builder = "karras"}),
              "no builder of the library is called 'karras'; there are: oibvh-single, oibvh-multi");
    EXPECT_EQ(option_refusal({.collider = "grid"}),
              "no collider of the library is called 'grid'; there are: leaf, group, block, bvtt");
    EXPECT_EQ(option_refusal({.order = "peano"}).substr(0, 46),
              "no order is called 'peano'; there are: morton3");
    EXPECT_EQ(refusal_of<BadInput>([] { oibvh::Device nowhere(nullptr); }),
              "a Device wants a cl_command_queue, and it is null");
    EXPECT_EQ(tuning_refusal("sort.luck", 1),
              "no tuning parameter is called 'sort.luck'; `bvhbench list tuning` has them");
    EXPECT_EQ(tuning_refusal("sort.group_size", 48),
              "tuning parameter sort.group_size must be a power of two, not 48");
    const oibvh::DeviceOptions tuned{.tuning = {{"chunks.per_core", 7}, {"walk.task_leaves", 16}}};
    tree = oibvh::Tree(oibvh::Device(caller.queue, tuned));
    expect_built();
}

TEST_F(LibraryRefuses, WhatMemoryDoesNotHold)
{
    tree = oibvh::Tree(oibvh::Device(caller.queue, {.memory_limit = 100000}));
    const std::string why =
        refusal_of<oibvh::Unavailable>([&] { tree.build(soup_mesh(5000).on_host()); });
    EXPECT_EQ(why.substr(0, 22), "out of device memory: ");
    EXPECT_NE(why.find("gives 100000"), std::string::npos) << why;
    expect_built();

    LibraryMesh crowded = soup_mesh(1);  // the tree fits, its pairs do not
    crowded.faces.resize(300, crowded.faces.front());
    tree.build(crowded.on_host());
    EXPECT_THROW(tree.find_pairs(), oibvh::Unavailable);
    expect_built();
}

}  // namespace
}  // namespace bvhbench
