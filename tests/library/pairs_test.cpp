// SPDX-License-Identifier: MIT
//
// The library finds the sweep oracle's pairs for all kinds of input, colliders and objects, after build, refit and update.
#include "collide/narrow/narrow.h"
#include "tests/library/testing.h"

namespace bvhbench {
namespace {

std::vector<std::pair<std::string, LibraryMesh>> meshes()
{
    std::vector<std::pair<std::string, LibraryMesh>> all;
    for (const std::size_t size : {1, 2, 3, 4, 5, 64, 65, 700})
        all.emplace_back("soup:" + std::to_string(size), soup_mesh(size));
    for (const char* scene : {"sphere:8", "torus:2000", "hairball:1500", "two-spheres:1200:1"})
        all.emplace_back(scene, scene_mesh(scene));
    LibraryMesh same = soup_mesh(1);
    same.faces.resize(40, same.faces.front());
    all.emplace_back("forty times the same", same);
    return all;
}

class LibraryCollider : public testing::TestWithParam<const char*> {};

TEST_P(LibraryCollider, FindsThePairsOfTheSweep)
{
    Caller caller;
    const oibvh::Device device(caller.queue);
    const std::string collider = GetParam();
    for (const bool sorted : {false, true})
        for (const bool adjacent : {false, true}) {
            oibvh::Tree tree(device, {.sorted_leaves = sorted,
                                      .collider = collider == "none" ? "" : collider,
                                      .adjacent_pairs = adjacent});
            for (const auto& [name, mesh] : meshes()) {
                tree.build(mesh.on_host());
                EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh, adjacent)) << name;
            }
        }
}
INSTANTIATE_TEST_SUITE_P(Named, LibraryCollider,
                         testing::Values("none", "leaf", "group", "block", "bvtt"),
                         [](const auto& collider) { return std::string(collider.param); });

class LibraryPairs : public OfACaller {};

TEST_F(LibraryPairs, OfBoxesAreThoseOfTheirTriangles)
{
    oibvh::Tree tree(device);
    for (const std::size_t size : {1, 2, 3, 700, 65}) {
        const LibraryMesh mesh = soup_mesh(size);
        const std::vector<oibvh::Box> boxes = mesh.boxes();
        tree.build(oibvh::HostBoxes{boxes});
        EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh)) << size;
        tree.build(oibvh::DeviceBoxes{caller.buffer_of(boxes), size});
        EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh)) << size;
    }
}

/// Every triangle overlaps every other: 499,500 pairs, while the pair buffer holds 8,000 at first.
TEST_F(LibraryPairs, GetRoomWhenTheyAreMore)
{
    LibraryMesh mesh = soup_mesh(1);
    mesh.faces.resize(1000, mesh.faces.front());
    for (const char* collider : {"leaf", "group", "bvtt"}) {
        oibvh::Tree tree(device, {.collider = collider});
        tree.build(mesh.on_host());
        EXPECT_EQ(found_pairs(tree, caller).size(), 499500u);
        const std::size_t taken = tree.memory();
        EXPECT_EQ(found_pairs(tree, caller).size(), 499500u);
        EXPECT_EQ(tree.memory(), taken);
    }
}

void expect_right(oibvh::Tree& tree, const Caller& caller, const ThreeObjects& objects,
                  const std::string& what)
{
    for (const auto& [asked, among] : amongs)
        EXPECT_EQ(found_pairs(tree, caller, asked), objects.right(among)) << what;
}

TEST_F(LibraryPairs, OfObjectsAreToldApart)
{
    const ThreeObjects objects;
    for (const char* collider : {"leaf", "group", "block", "bvtt"}) {
        oibvh::Tree tree(device, {.collider = collider});
        tree.build(objects.mesh.on_host(), objects.sizes);
        EXPECT_EQ(tree.buffers().object_count, 3u);
        EXPECT_EQ(tree.levels(1).back().node_count, 300u);
        expect_right(tree, caller, objects, collider);
        tree.build(objects.mesh.on_device(caller), objects.sizes);
        expect_right(tree, caller, objects, collider);
        tree.build(objects.mesh.on_host());  // one object again
        EXPECT_EQ(found_pairs(tree, caller), objects.right(Among::all));
        EXPECT_EQ(found_pairs(tree, caller, oibvh::Among::between_objects).size(), 0u);
    }
}

TEST_F(LibraryPairs, LeaveOutWhatAFilterDoes)
{
    const ThreeObjects objects;
    const std::vector<oibvh::Excluded> excluded = {{2, 1}, {1, 1}, {1, 2}};
    const std::vector<std::uint32_t> groups = {1, 2, 4}, masks = {~0u, 4, 2};  // 0 meets nobody
    const struct {
        oibvh::Filter given;
        ObjectFilter meant;
    } filters[] = {{{}, {}},
                   {{.excluded = excluded}, {.excluded = {{1, 1}, {1, 2}}}},
                   {{.groups = groups, .masks = masks}, {.excluded = {{0, 1}, {0, 2}}}},
                   {{.excluded = excluded, .groups = groups, .masks = masks},
                    {.excluded = {{0, 1}, {0, 2}, {1, 1}, {1, 2}}}}};
    for (const char* collider : {"leaf", "group", "block", "bvtt"}) {
        oibvh::Tree tree(device, {.collider = collider});
        tree.build(objects.mesh.on_host(), objects.sizes);
        for (const auto& [given, meant] : filters)
            for (const auto& [asked, among] : amongs) {
                tree.find_pairs(asked, given);
                const PairList wanted = chosen(objects.right(among), [&](Pair pair) {
                    const auto owner = [](uint k) { return k < 1 ? 0u : k < 301 ? 1u : 2u; };
                    return meant.allows(owner(pair.a), owner(pair.b));
                });
                EXPECT_EQ(pair_list(tree.read_pairs()), wanted)
                    << collider << meant.excluded.size();
            }
        expect_right(tree, caller, objects, collider);  // without a filter again
    }
}

/// Held against the exact test of the host, which tests/collide/narrow_test.cpp compares with CGAL.
TEST_F(LibraryPairs, HaveAFirstContactIfTrianglesIntersect)
{
    int answers[2] = {};
    for (const std::uint32_t size : {2u, 7u, 40u, 700u})
        for (const bool adjacent : {false, true}) {
            LibraryMesh mesh = soup_mesh(size);
            for (std::size_t k = 1; k < size; k += 2)
                mesh.faces[k].a = mesh.faces[k - 1].b;
            const Mesh own = mesh.mesh();
            oibvh::Tree tree(device, {.collider = "bvtt", .adjacent_pairs = adjacent});
            const std::vector<std::uint32_t> sizes = {1, size - 1};
            tree.build(mesh.on_device(caller), sizes);
            const PairList pairs = found_pairs(tree, caller);
            const auto expect_right = [&](std::optional<oibvh::Pair> found, bool of_first) {
                const PairList right = chosen(pairs, [&](Pair pair) {
                    return (pair.a == 0 || !of_first) &&
                           triangles_meet(own.points, own.faces, pair, adjacent);
                });
                ++answers[found.has_value()];
                EXPECT_EQ(found.has_value(), right.size() > 0) << size;
                if (found) {
                    EXPECT_TRUE(
                        std::ranges::binary_search(right.pairs(), Pair{found->a, found->b}));
                }
            };
            const std::vector<oibvh::Excluded> within = {{1, 1}};
            expect_right(tree.first_contact(), false);
            expect_right(tree.first_contact(oibvh::Among::all, {.excluded = within}), true);
            expect_right(tree.first_contact(oibvh::Among::between_objects), true);
            EXPECT_EQ(pair_list(tree.read_pairs()), pairs) << "as they were";
            mesh.points.assign(mesh.points.size(), {0, 0, 0});
            tree.refit(mesh.on_host());  // all in one place
            EXPECT_EQ(tree.first_contact().has_value(), size > 2) << size;
        }
    EXPECT_GT(answers[0], 5);
    EXPECT_GT(answers[1], 5);
    oibvh::Tree tree(device);
    EXPECT_THROW(tree.first_contact(), oibvh::BadInput);
    const std::vector<oibvh::Box> boxes = soup_mesh(9).boxes();
    tree.build(oibvh::HostBoxes{boxes});
    EXPECT_EQ(refusal_of<oibvh::BadInput>([&] { tree.first_contact(); }),
              "boxes have overlaps but no contacts: those are of triangles");
}

TEST_F(LibraryPairs, FollowTrianglesThatMove)
{
    using oibvh::Update;
    const std::vector<std::vector<Update>> ways = {
        {Update::rebuild, Update::rebuild, Update::rebuild},
        {Update::refit, Update::refit, Update::refit},
        {Update::keep, Update::refit, Update::rebuild},
        {Update::keep, Update::rebuild, Update::keep},
        {Update::keep, Update::keep, Update::keep},
        {Update::refit, Update::keep, Update::rebuild}};
    for (const bool sorted : {false, true}) {
        ThreeObjects objects;
        oibvh::Tree tree(device, {.sorted_leaves = sorted});
        tree.build(objects.mesh.on_host(), objects.sizes);
        for (std::size_t way = 0; way < ways.size(); ++way) {
            for (std::size_t object = 0; object < 3; ++object)
                if (ways[way][object] != Update::keep)
                    objects.move(object, 0.01f);
            tree.update(objects.mesh.on_host(), ways[way]);
            expect_right(tree, caller, objects, "update " + std::to_string(way));
        }
        objects.move(1, 0.02f);
        tree.refit(objects.mesh.on_device(caller));
        expect_right(tree, caller, objects, "refit");
    }
}

TEST_F(LibraryPairs, OfOneObjectFollowItToo)
{
    LibraryMesh mesh = soup_mesh(300);
    oibvh::Tree tree(device);
    tree.build(mesh.on_host());
    for (const oibvh::Update update : {oibvh::Update::refit, oibvh::Update::rebuild}) {
        for (std::size_t k = 0; k < mesh.points.size(); ++k)
            mesh.points[k].y += 0.02f * static_cast<float>(k % 5);
        tree.update(mesh.on_host(), {&update, 1});
        EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
    }
    const oibvh::Update keep = oibvh::Update::keep;
    tree.update(mesh.on_host(), {&keep, 1});
    EXPECT_EQ(found_pairs(tree, caller), swept_pairs(mesh));
}

/// Returns the overlapping pairs of a triangle of `a` and one of `b`, by brute force.
std::vector<oibvh::Pair> each_with_each(const LibraryMesh& a, const LibraryMesh& b)
{
    std::vector<oibvh::Pair> pairs;
    const auto first = a.boxes(), second = b.boxes();
    for (std::uint32_t i = 0; i < first.size(); ++i)
        for (std::uint32_t j = 0; j < second.size(); ++j)
            if (overlap(aabb_of(first[i]), aabb_of(second[j])))
                pairs.push_back({i, j});
    return pairs;
}

TEST_F(LibraryPairs, BetweenTreesBuiltApartAreThoseOfEachWithEach)
{
    for (const bool sorted : {false, true})
        for (const char* collider : {"leaf", "group", "block", "bvtt"}) {
            const oibvh::Options options{.sorted_leaves = sorted, .collider = collider};
            oibvh::Tree a(device, options), b(device, options);
            const std::pair<std::size_t, std::size_t> sizes[] = {
                {1, 1}, {1, 2}, {3, 1}, {300, 77}, {77, 300}};
            for (const auto& [first, second] : sizes) {
                const LibraryMesh mesh = soup_mesh(first, 3), other = soup_mesh(second, 4);
                a.build(mesh.on_host());
                b.build(other.on_host());
                for (int time = 0; time < 2; ++time) {  // the second reuses memory
                    const oibvh::Pairs found = a.find_pairs(b);
                    std::vector<oibvh::Pair> pairs = a.read_pairs();
                    EXPECT_EQ(pairs, caller.values_of<oibvh::Pair>(found.pairs, pairs.size()));
                    EXPECT_EQ(pairs.size(), found.count);
                    std::sort(pairs.begin(), pairs.end());
                    EXPECT_EQ(pairs, each_with_each(mesh, other)) << collider << ' ' << first;
                }
                EXPECT_EQ(found_pairs(a, caller),
                          swept_pairs(mesh));  // its own pairs are unchanged
                a.find_pairs(a);
                std::vector<oibvh::Pair> with_itself = a.read_pairs();
                std::sort(with_itself.begin(), with_itself.end());
                EXPECT_EQ(with_itself, each_with_each(mesh, mesh));
            }
        }
}

}  // namespace
}  // namespace bvhbench
