// SPDX-License-Identifier: MIT
//
// The library's trees equal those of bvhbench's builders bit for bit, and its buffers have the documented layout.

#include "builders/implicit/tree.h"
#include "oibvh/oibvh.h"
#include "tests/builders/stage_testing.h"
#include "tests/library/testing.h"

namespace bvhbench {
namespace {

constexpr std::size_t critical_sizes[] = {1, 2, 3, 4, 5, 7, 8, 9, 63, 64, 65, 1000};

template <class T, class U>
bool same_bytes(const std::vector<T>& a, const std::vector<U>& b)
{
    return a.size() * sizeof(T) == b.size() * sizeof(U) &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// A mesh and the tree that the builder of `make` builds over it.
struct Built {
    Mesh mesh;
    Input input;
    std::unique_ptr<Builder> builder;
    const ImplicitTree* tree;

    Built(const LibraryMesh& over, MakeBuilder make, const BuildOptions& options)
        : mesh(over.mesh())
        , input(upload(bench().device, bench().queue, mesh.points, mesh.faces))
        , builder(make(bench().programs, options))
    {
        builder->reserve(mesh.faces.size());
        tree = &dynamic_cast<const ImplicitTree&>(builder->build(input, bench().queue));
        bench().queue.finish();
    }
};

void expect_same(const oibvh::HostTree& read, const ImplicitTree& tree, const std::string& what)
{
    const cl::CommandQueue& queue = bench().queue.cl();
    EXPECT_TRUE(same_bytes(read.nodes, tree.nodes.download(queue))) << what;
    EXPECT_TRUE(same_bytes(read.leaf_boxes, tree.leaf_boxes.download(queue))) << what;
    EXPECT_TRUE(same_bytes(read.ids, tree.ids.download(queue))) << what;
    EXPECT_TRUE(same_bytes(read.objects, tree.objects)) << what;
}

class LibraryBuilder : public testing::TestWithParam<const char*> {};

TEST_P(LibraryBuilder, IsTheProgramsTreeBitForBit)
{
    const MakeBuilder make =
        GetParam() == std::string("oibvh-single") ? make_oibvh_single : make_oibvh_multi;
    Caller caller;
    const oibvh::Device device(caller.queue);
    for (const char* order : {"morton30", "hilbert30", "kd"})
        for (const bool sorted : {false, true}) {
            oibvh::Tree tree(device,
                             {.builder = GetParam(), .order = order, .sorted_leaves = sorted});
            for (const std::size_t size : critical_sizes) {
                const LibraryMesh mesh = soup_mesh(size);
                tree.build(mesh.on_host());
                const Built built(mesh, make, {.order = order, .sorted_leaves = sorted});
                expect_same(
                    tree.read(), *built.tree,
                    std::string(order) + (sorted ? " sorted " : " ") + std::to_string(size));
            }
            EXPECT_EQ(tree.builder(), GetParam());
        }
}
INSTANTIATE_TEST_SUITE_P(Named, LibraryBuilder, testing::Values("oibvh-single", "oibvh-multi"),
                         [](const auto& builder) { return std::string(builder.param).substr(6); });

/// Returns the tree that levels, nodes, leaf boxes and ids describe, as an internal HostTree.
HostTree told(const oibvh::HostTree& read, const std::vector<oibvh::Level>& levels,
              const oibvh::Object& object)
{
    HostTree tree;
    std::size_t below = 0;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        below += levels[level].node_count;
        for (std::uint32_t p = 0; p < levels[level].node_count; ++p) {
            HostTree::Node& node = tree.nodes.emplace_back();
            const bool is_leaf = level + 1 == levels.size();
            if (is_leaf)
                node.primitive = static_cast<int>(read.ids[object.first + p]);
            node.box = aabb_of(is_leaf && !read.leaf_boxes.empty()
                                   ? read.leaf_boxes[static_cast<std::size_t>(node.primitive)]
                                   : read.nodes[object.nodes + levels[level].first_slot + p]);
            if (is_leaf)
                continue;
            node.child[0] = static_cast<int>(below + 2 * p);
            if (2 * p + 1 < levels[level + 1].node_count)
                node.child[1] = static_cast<int>(below + 2 * p + 1);
        }
    }
    return tree;
}

class Library : public OfACaller {};

TEST_F(Library, HasTheSameTreeOfEveryKindOfInput)
{
    oibvh::Tree tree(device);
    for (const std::size_t size : {1, 2, 3, 1000}) {
        const LibraryMesh mesh = soup_mesh(size);
        const std::vector<oibvh::Box> boxes = mesh.boxes();
        tree.build(mesh.on_host());
        const oibvh::HostTree first = tree.read();
        const oibvh::Input others[] = {mesh.on_device(caller), oibvh::HostBoxes{boxes},
                                       oibvh::DeviceBoxes{caller.buffer_of(boxes), size}};
        for (const oibvh::Input& other : others) {
            tree.build(other);
            const oibvh::HostTree read = tree.read();
            EXPECT_TRUE(same_bytes(read.nodes, first.nodes)) << size << ' ' << other.index();
            EXPECT_EQ(read.ids, first.ids) << size << ' ' << other.index();
        }
    }
}

TEST_F(Library, TellsWhereItsTreeIs)
{
    const LibraryMesh mesh = soup_mesh(37);
    for (const bool sorted : {false, true}) {
        oibvh::Tree tree(device, {.sorted_leaves = sorted});
        tree.build(mesh.on_host());
        const oibvh::Buffers buffers = tree.buffers();
        const oibvh::HostTree read = tree.read();
        EXPECT_EQ(buffers.leaf_count, 37u);
        EXPECT_EQ(buffers.object_count, 1u);
        EXPECT_EQ(buffers.leaf_boxes == nullptr, sorted);
        EXPECT_EQ(buffers.node_count, read.nodes.size());
        // 37 leaves and 27 virtual leaves give 2 * 37 - 1 + popcount(27) nodes, Eq. (7).
        EXPECT_EQ(buffers.node_count + (sorted ? 0 : 37), 77u);
        EXPECT_TRUE(same_bytes(caller.values_of<oibvh::Box>(buffers.nodes, buffers.node_count),
                               read.nodes));
        EXPECT_EQ(caller.values_of<std::uint32_t>(buffers.ids, 37), read.ids);
        EXPECT_TRUE(same_bytes(caller.values_of<oibvh::Object>(buffers.objects, 1), read.objects));
    }
}

TEST_F(Library, LevelsNodesAndIdsAreAllThereIsToKnow)
{
    for (const bool sorted : {false, true}) {
        oibvh::Tree tree(device, {.order = "morton30", .sorted_leaves = sorted});
        for (const std::size_t size : critical_sizes) {
            const LibraryMesh mesh = soup_mesh(size);
            tree.build(mesh.on_host());
            const Built built(mesh, make_oibvh_multi, {.sorted_leaves = sorted});
            const oibvh::HostTree read = tree.read();
            EXPECT_EQ(tree_hash(told(read, tree.levels(), read.objects[0])),
                      tree_hash(built.tree->to_host_tree()))
                << size;
        }
    }
}

}  // namespace
}  // namespace bvhbench
