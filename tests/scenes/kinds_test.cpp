// SPDX-License-Identifier: MIT
//
// Files of every kind hold a model that the test knows. What is read must be that model: its triangles corner for corner, its
// objects, and which triangles share vertices. Where assimp reads all of a kind too, it must find as many triangles in the same box.
#include "kinds.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <map>

#include "helpers.h"

namespace bvhbench {
namespace {

using Triangle = std::array<std::array<double, 3>, 3>;

std::vector<Triangle> triangles_of(const Model& model)
{
    std::vector<Triangle> all;
    for (const Model::Part& part : model.parts)
        for (const auto& [a, b, c] : part.faces)
            all.push_back({part.points[a], part.points[b], part.points[c]});
    return all;
}

std::vector<Triangle> triangles_of(const Scene& scene)
{
    std::vector<Triangle> all;
    const auto at = [&](uint corner) {
        const Point& p = scene.frames[0][corner];
        return std::array<double, 3>{p.x, p.y, p.z};
    };
    for (const Face& face : faces_in_file(scene))
        all.push_back({at(face.a), at(face.b), at(face.c)});
    return all;
}

/// Returns how many triangles each edge of a model belongs to, as numbers of edges of one, two and more.
std::array<std::uint64_t, 3> edges_of(const Model& model)
{
    std::array<std::uint64_t, 3> counts = {};
    for (const Model::Part& part : model.parts) {
        std::map<std::pair<unsigned, unsigned>, int> edges;
        for (const auto& [a, b, c] : part.faces)
            for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
                ++edges[std::minmax(u, v)];
        for (const auto& [edge, count] : edges)
            ++counts[std::min<std::size_t>(static_cast<std::size_t>(count), 3) - 1];
    }
    return counts;
}

/// Compares numbers of triangles, and boxes, with what assimp finds in this process. False if it does not read the file.
bool is_as_assimp(const std::string& path, const std::vector<Triangle>& triangles)
{
    Assimp::Importer importer;
    const aiScene* const scene =
        importer.ReadFile(path, aiProcess_PreTransformVertices | aiProcess_Triangulate);
    if (scene == nullptr)
        return false;
    std::size_t count = 0;
    std::array<double, 3> low = {1e9, 1e9, 1e9}, high = {-1e9, -1e9, -1e9}, least = low,
                          most = high;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
        const aiMesh& mesh = *scene->mMeshes[m];
        count += mesh.mNumFaces;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
                for (unsigned axis = 0; axis < 3; ++axis) {
                    const double x = mesh.mVertices[mesh.mFaces[f].mIndices[k]][axis];
                    low[axis] = std::min(low[axis], x);
                    high[axis] = std::max(high[axis], x);
                }
    }
    for (const Triangle& triangle : triangles)
        for (const auto& corner : triangle)
            for (unsigned axis = 0; axis < 3; ++axis) {
                least[axis] = std::min(least[axis], corner[axis]);
                most[axis] = std::max(most[axis], corner[axis]);
            }
    EXPECT_EQ(count, triangles.size());
    EXPECT_EQ(low, least);
    EXPECT_EQ(high, most);
    return true;
}

class EveryKind : public testing::TestWithParam<Kind> {};

TEST_P(EveryKind, IsReadWhole)
{
    const Kind& kind = GetParam();
    const bool in_worker = std::string_view(kind.name).ends_with(".dae") ||
                           std::string_view(kind.name).ends_with(".x");
    const Folder folder;
    int compared = 0;
    for (unsigned seed = 0; seed < (in_worker ? 10u : 40u); ++seed) {
        SCOPED_TRACE(seed);
        Chance chance{std::mt19937(seed)};
        const Model model = random_model(chance);
        chance.is_plain = std::string_view(kind.name).starts_with("plain");
        const std::string path = folder.file(kind.name, kind.write(model, chance));
        Listening library;
        const Scene scene = load_scene(path, library);
        const std::vector<Triangle> expected = triangles_of(model);
        ASSERT_EQ(triangles_of(scene), expected);
        EXPECT_EQ(scene.objects.size(), kind.keeps_objects ? model.parts.size() : 1);
        if (kind.keeps_sharing) {
            const auto [open, shared, more] = edges_of(model);
            EXPECT_EQ(scene.facts->open_edges, open);
            EXPECT_EQ(scene.facts->shared_edges, shared);
            EXPECT_EQ(scene.facts->nonmanifold_edges, more);
        } else {
            EXPECT_EQ(scene.facts->shared_edges, 0u);
            EXPECT_TRUE(contains(library.told, "--weld would join"));
        }
        library.weld = true;
        EXPECT_EQ(load_scene(path, library).facts->shared_edges, edges_of(model)[1]);
        if (kind.assimp_reads && is_as_assimp(path, expected))
            ++compared;
        if (HasFailure())
            return;
    }
    EXPECT_EQ(compared > 0, kind.assimp_reads);
}

INSTANTIATE_TEST_SUITE_P(Each, EveryKind, testing::ValuesIn(kinds()), CaseName());

/// Returns a glTF file of tetrahedra at the places of its nodes, whose mesh names 4 of `vertices` vertices, once for each of `primitives`.
std::string tetrahedra(const std::string& nodes, unsigned vertices = 4, unsigned primitives = 1)
{
    // Positions are zeros that a sparse accessor changes: three corners, 1.2 from the first.
    const std::string base64 =
        "AQACAAMAAACamZk/"
        "AAAAAAAAAAAAAAAAmpmZPwAAAAAAAAAAAAAAAJqZmT8AAAEAAgAAAAEAAwAAAAIAAwABAAIAAwA=";
    std::string list;
    for (unsigned k = 0; k < primitives; ++k)
        list += std::string(k == 0 ? "" : ",") + R"({"attributes": {"POSITION": 0}, "indices": 1})";
    return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}], "nodes": [)" + nodes +
           R"(], "meshes": [{"primitives": [)" + list +
           R"(]}], "accessors": [{"componentType": 5126, "count": )" + std::to_string(vertices) +
           R"(, "type": "VEC3", "sparse": {"count": 3, "indices": {"bufferView": 0, "componentType": 5123},
"values": {"bufferView": 0, "byteOffset": 8}}}, {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteLength": 44}, {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
"buffers": [{"byteLength": 68, "uri": "data:application/octet-stream;base64,)" +
           base64 + "\"}]}";
}

using Gltf = InFolder;

TEST_F(Gltf, OfNodesFarAwayIsRecentredInDoubles)
{
    const auto gap = [&](const char* first, const char* second) {
        Listening library;
        const Scene scene = load_scene(
            folder.file("far.gltf",
                        tetrahedra(std::string(R"({"mesh": 0, "translation": [)") + first +
                                   R"(]}, {"mesh": 0, "translation": [)" + second + "]}")),
            library);
        EXPECT_TRUE(contains(library.told, "doubles, as floats around ("));
        EXPECT_LT(scene.rounding.largest_error, 1e-7);
        return double{scene.frames[0][4].y} -
               scene.frames[0][2].y;  // from corner to origin, along y
    };
    EXPECT_NEAR(gap("1335838.5, -4659713.76, 4131346.2", "1335838.2, -4659712.7, 4131345.9"), -0.14,
                1e-6);
    EXPECT_NEAR(gap("1335838.5, -4659713.76, 4131346.2", "1335838.5, -4659712.46, 4131346.2"), 0.1,
                1e-6);
}

TEST_F(Gltf, KeepsTheVerticesThatTrianglesName)
{
    const Scene scene =
        loaded("many.gltf",
               tetrahedra(R"({"mesh": 0}, {"mesh": 0, "translation": [2, 0, 0]})", 60000, 500));
    EXPECT_EQ(scene.faces.size(), 2u * 500u * 4u);
    EXPECT_EQ(scene.frames[0].size(), 8u);  // the primitives of an instance share them
    EXPECT_EQ(scene.objects.size(), 2u);
}

TEST(Strips, HaveEveryOtherTriangleTurnedRound)
{
    const Folder folder;
    std::string strip = tetrahedra(R"({"mesh": 0}, {})");  // of corners 0 1 2 0 1 3 ...
    strip.replace(strip.find(R"("indices": 1})"), 13, R"("indices": 1, "mode": 5})");
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
        "float z\n"
        "element tristrips 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n0 0 1\n6 0 1 2 0 1 3\n";
    for (const std::string& path : {folder.file("a.gltf", strip), folder.file("a.ply", ply)}) {
        const Face second = load_scene(path, {}).faces[1];
        std::array corners = {second.a, second.b, second.c};
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
        EXPECT_EQ(corners, (std::array{0u, 2u, 1u})) << path;  // the same side as the first
    }
}

}  // namespace
}  // namespace bvhbench
