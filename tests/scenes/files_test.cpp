// SPDX-License-Identifier: MIT
#include <cmath>
#include <map>

#include "helpers.h"
#include "kinds.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

constexpr const char* ply_header =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\n";
constexpr const char* ply_values = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

std::string ascii_ply(const std::string& values = ply_values)
{
    return std::string("ply\nformat ascii 1.0\n") + ply_header + "end_header\n" + values;
}

std::string binary_ply(bool big)
{
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\n" + ply_header + "end_header\n";
    for (const float coordinate : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
        append(bytes, coordinate, big);
    for (const std::int32_t second : {1, 2}) {
        append(bytes, std::uint8_t{3});
        for (const std::int32_t corner : {0, second, second + 1})
            append(bytes, corner, big);
    }
    return bytes;
}

std::string binary_stl()
{
    std::string bytes = "binary";
    bytes.resize(80);
    append(bytes, std::uint32_t{2});
    for (const float third : {1.0f, 2.0f}) {
        for (const float value : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, third, 0.f, 0.f, 0.f, 1.f, 0.f})
            append(bytes, value);
        append(bytes, std::uint16_t{0});
    }
    return bytes;
}

using Files = InFolder;

// kinds_test reads triangles in every spelling.
TEST_F(Files, OfAnyCaseMayHaveFacesOfMoreCorners)
{
    const Scene scene =
        loaded("a.OFF", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0 # c\n\n0 1 0\n4 0 1 2 3 255 0 0\n");
    ASSERT_EQ(scene.triangle_count(), 2u);
    EXPECT_EQ(scene.faces[1].b, 2u);
    EXPECT_EQ(scene.faces[1].c, 3u);
}

TEST_F(Files, OfStlNameTheirSolids)
{
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
        "0\nendloop\nendfacet\n";
    const Scene scene =
        loaded("b.stl", "solid one\n" + facet + "endsolid\nsolid two\n" + facet + "endsolid\n");
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[1].name, "two");
}

TEST_F(Files, OfPlyHaveObjectsByObjectId)
{
    const std::string header = std::string("ply\nformat ascii 1.0\n") + ply_header +
                               "property ushort object_id\nend_header\n";
    const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const Scene two = loaded("two.ply", header + points + "3 0 1 2 4\n4 0 1 2 3 7\n");
    ASSERT_EQ(two.objects.size(), 2u);
    EXPECT_EQ(two.objects[0].face_count, 1u);
    EXPECT_EQ(two.objects[1].first_face, 1u);
    EXPECT_EQ(two.objects[1].face_count, 2u);
    EXPECT_TRUE(two.file_faces.empty());
    EXPECT_EQ(two.object_ids, (std::vector<std::int64_t>{4, 7}));
    const Scene mixed = loaded("mixed.ply", header + points + "3 0 1 2 4\n3 0 2 3 3\n");
    ASSERT_EQ(mixed.objects.size(), 2u);
    EXPECT_EQ(mixed.object_ids, (std::vector<std::int64_t>{3, 4}));
    EXPECT_EQ(mixed.file_faces, (std::vector<uint>{1, 0}));
    EXPECT_EQ(mixed.objects[1].first_face, 1u);
    EXPECT_EQ(mixed.faces[0].b, 2u);
}

TEST_F(Files, LoseNegativeZerosAndKeepEverythingElse)
{
    const Scene scene =
        loaded("a.obj", "v -0 -0.0 1e-45\nv 1 0 0\nv 1 0 0\nf 1 2 3\nf 1 1 1\nf 1 2 3\n");
    EXPECT_FALSE(std::signbit(scene.frames[0][0].x));
    EXPECT_EQ(scene.frames[0][0].z, 1e-45f);
    EXPECT_EQ(scene.frames[0].size(), 3u);  // equal vertices are not merged
    EXPECT_EQ(scene.triangle_count(), 3u);  // degenerate and repeated triangles are kept
}

TEST_F(Files, PassOverLinesAndPoints)
{
    EXPECT_EQ(loaded("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2\np 1\nf 1 2 3").triangle_count(),
              1u);
    EXPECT_TRUE(refuses(folder.file("b.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "has no triangles"));
}

struct Bad {
    const char* name;
    std::string bytes;
    const char* message;
};

class BadFile : public testing::TestWithParam<Bad> {};

TEST_P(BadFile, IsRefusedInOneSentenceThatSaysWhat)
{
    const Folder folder;
    const std::string message = refusal(folder.file(GetParam().name, GetParam().bytes));
    EXPECT_TRUE(contains(message, "Unavailable: "));
    EXPECT_TRUE(contains(message, GetParam().name));
    EXPECT_TRUE(contains(message, GetParam().message));
    EXPECT_EQ(message.find('\n'), message.npos);
}

const Bad bad_files[] = {
    {"empty.obj", "", "has no triangles"},
    {"zero.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 0 1 2\n", "line 4: a face names vertex 0"},
    {"range.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n", "0, with vertex 3 of 3"},
    {"back.obj", "v 0 0 0\nf -1 -2 -3\n", "line 2: a face names vertex -2, and there are 1"},
    {"two.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "line 3: a face takes three corners, and there are 2"},
    {"comma.obj", "v 0,5 0 0\n", "line 1: a vertex takes three numbers, and there is '0,5 0 0'"},
    {"nan.obj", "v 0 0 0\nv 1 nan 0\nv 1 1 0\nf 1 2 3\n", "a vertex, 1, that is not finite"},
    {"huge.obj", "v 1e999 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "a vertex, 0, that is not finite"},
    {"wide.obj", std::string("\xff\xfev\0 \0", 6), "is UTF-16 text"},
    {"none.ply", "", "does not end with end_header"},
    {"text.ply", "a shopping list\nmilk\n", "begins with ply, and there is 'a shoppi'"},
    {"faces.ply", ascii_ply("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
     "face 1 of 2: the file ends too soon"},
    {"index.ply", ascii_ply("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 4\n"),
     "face 1 of 2: it names vertex 4 of 4"},
    {"minus.ply", ascii_ply("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 -1\n"),
     "face 1 of 2: it names vertex -1 of 4"},
    {"more.ply", ascii_ply(std::string(ply_values) + "3 0 1 2\n"),
     "bytes more than its header says"},
    {"cut.ply", binary_ply(false).substr(0, 200), "ends too soon"},
    {"many.ply",
     "ply\nformat ascii 1.0\nelement vertex 9000000000000000000\nproperty float x\nproperty float "
     "y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n",
     "ends too soon: its header says 9000000000000000000"},
    {"flat.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nelement face "
     "1\nproperty list uchar int vertex_indices\nend_header\n",
     "has vertices without one z"},
    {"type.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\nend_header\n",
     "line 4: not a type of PLY: 'half'"},
    {"count.off", "OFF\n4 1000000 0\n",
     "line 2: the header says 1000000 faces, and the file has 16 bytes"},
    {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
     "line 6: a face names vertex 3 of 3"},
    {"cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "line 4: the file ends at vertex 2 of 3"},
    {"head.off", "3 1 0\n0 0 0\n", "begins with OFF, and there is '3'"},
    {"cut.stl", binary_stl().substr(0, 150), "says 2 facets, which take 184 bytes, and has 150"},
    {"open.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
     "line 4: the file ends inside the facet of line 2"},
    {"short.stl", "solid a\nfacet\nvertex 0 0 0\nendfacet\nendsolid\n",
     "line 4: a facet takes three vertices, and there are 1"},
    {"facet.stl", "solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nfacet\n",
     "line 6: a facet begins, and the facet of line 2 has no endfacet"},
    {"solids.stl", "solid a\nsolid b\nendsolid\n",
     "line 2: a solid begins, and the solid of line 1 has no endsolid"},
    {"inside.stl", "Solid a\nFacet\nendsolid\n", "line 3: a solid ends, and the facet of line 2"},
    {"outside.stl", "solid a\nendsolid\nfacet\n", "line 3: a facet stands outside of a solid"},
    {"longer.stl", "SOLID" + binary_stl().substr(5) + "more", "which take 184 bytes, and has 188"},
    {"binary.off", "OFF BINARY\n1 1 0\n", "line 1: binary OFF is not read"},
    {"four.off", "4OFF\n1 1 0\n", "begins with OFF, and there is '4OFF'"},
    {"glued.off", "OFF8x 3 0\n", "begins with OFF, and there is 'OFF8x'"},
    {"surface.obj", "v 0 0 0\ncstype bezier\n", "line 2: 'cstype' is not read"},
    {"call.obj", "call other.obj\n", "line 1: 'call' is not read"},
    {"strips.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
     "z\nelement tristrips 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 "
     "1 0\n3 0 1 3\n",
     "tristrips 0 of 1: it names vertex 3 of 3"},
    {"old.gltf", R"({"asset": {"version": "1.0"}})", "is of glTF version '1.0', and version 2"},
    {"torn.gltf", R"({"asset": {)", "its JSON is damaged"},
    {"short.glb", std::string("glTF\2\0\0\0\x99\0\0\0", 12) + "12345678",
     "says that it has 153 bytes"},
    {"draco.gltf",
     R"({"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"]})",
     "requires 'KHR_draco_mesh_compression', which is not read"},
    {"meshopt.gltf",
     R"({"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_mesh_quantization", "EXT_meshopt_compression"]})",
     "requires 'EXT_meshopt_compression', which is not read"},
    {"twice.gltf",
     R"({"asset": {"version": "2.0"}, "nodes": [{"children": [1]}, {"children": [0]}]})",
     "has nodes that are their own parents"},
    {"parents.gltf",
     R"({"asset": {"version": "2.0"}, "nodes": [{"children": [2]}, {"children": [2]}, {}]})",
     "has a node, 2, with two parents"},
    {"mesh.gltf",
     R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 3}], "scenes": [{"nodes": [0]}]})",
     "names number 3 of 'meshes', which has 0"},
    {"beyond.gltf",
     R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 12}],
"buffers": [{"byteLength": 12, "uri": "data:;base64,AAAAAAAAAAAAAAAA"}]})",
     "has an accessor that reaches beyond the end of its buffer view, 0"},
    {"line.stl", "solid\nendsolid a facet\n",
     "line 2: the name of a solid goes to the end of its line"},
    {"note.stl", "# a note\nsolid\n",
     "is text, and an ascii STL file begins with solid, not with '#'"},
    {"trail.obj", "v 0 0 0\nv 1 0 0 red\n", "line 2: a vertex takes numbers"},
    {"strip.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
     "z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n-3\n",
     "tristrips 0 of 1: a list of length -3"},
    {"zeros.gltf",
     R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"componentType": 5126, "count": 3000000, "type": "VEC3"}]})",
     "has an accessor of 3000000 elements without a buffer view"},
    {"string.gltf",
     R"({"asset": {"version": "2.0"}, "extensionsRequired": "KHR_draco_mesh_compression"})",
     "has 'extensionsRequired' that are no list"},
    {"later.gltf", R"({"asset": {"version": "2.0", "minVersion": "2.1"}})", "needs glTF version"},
    {"fan.dae", "<COLLADA><trifans count=\"1\"/></COLLADA>", "it has trifans"},
    {"gone.dae", "<COLLADA><instance_geometry url=\"#g\"/></COLLADA>",
     "an instance of '#g', which is not in it"},
    {"below.dae", "<COLLADA><p>0 1 -1</p></COLLADA>", "names a vertex below 0"},
    {"array.dae",
     "<COLLADA><float_array id=\"a\" count=\"12\">0</float_array><accessor source=\"#a\" "
     "count=\"4\" stride=\"4\"/></COLLADA>",
     "an accessor of 4 elements beyond the end of its array of 12 numbers"},
    {"parts.3mf",
     "PK\1\2" + std::string(24, 'x') + std::string("\7\0", 2) + std::string(16, 'x') + "a.model" +
         "PK\1\2" + std::string(24, 'x') + std::string("\7\0", 2) + std::string(16, 'x') +
         "b.model",
     "several model parts, and assimp reads one of them"},
    {"volumes.amf", "<amf><object><mesh><volume/><volume/></mesh></object></amf>",
     "several volumes"},
    {"notes.txt", "hello", "of a format that is not read, '.txt'"},
};

INSTANTIATE_TEST_SUITE_P(Each, BadFile, testing::ValuesIn(bad_files), CaseName());

TEST_F(Files, ThatAreNotThereAreNamed)
{
    EXPECT_EQ(refusal("/nowhere/a.obj"), "Unavailable: there is no file /nowhere/a.obj");
    EXPECT_EQ(refusal("/dev/null"), "Unavailable: /dev/null is not a file");
}

struct NastyFile {
    std::string name, outcome, triangles, without_area, open_edges, nonmanifold_edges;
};

std::vector<std::string> csv_fields(const std::string& line)
{
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line)
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    return fields;
}

std::vector<NastyFile> listed(const std::filesystem::path& manifest)
{
    std::ifstream file(manifest);
    std::vector<NastyFile> result;
    std::string line;
    std::getline(file, line);  // the column names
    while (std::getline(file, line)) {
        const auto fields = csv_fields(line);
        result.push_back(
            {fields.at(0), fields.at(3), fields.at(4), fields.at(6), fields.at(7), fields.at(8)});
    }
    return result;
}

/// Loads every file of a folder of difficult meshes, listed in its MANIFEST.csv. Files listed as "load" must load.
TEST(NastyFiles, LoadWithTheListedTrianglesOrAreRefusedInOneSentence)
{
    const std::filesystem::path folder = data_folder() / "nasty";
    if (!std::filesystem::exists(folder / "MANIFEST.csv"))
        GTEST_SKIP() << "BVHBENCH_DATA names no data folder with nasty/MANIFEST.csv";
    std::map<std::string, int> outcomes;
    for (const NastyFile& file : listed(folder / "MANIFEST.csv")) {
        SCOPED_TRACE(file.name + ", listed as " + file.outcome);
        std::string what;
        try {
            SceneLibrary library;  // the list joins the vertices of STL to count its edges
            library.weld = lower_case((folder / file.name).extension().string()) == ".stl";
            const Scene scene = load_scene((folder / file.name).string(), library);
            if (!file.triangles.empty()) {
                EXPECT_EQ(std::to_string(scene.triangle_count()), file.triangles);
            }
            const MeshFacts& facts = *scene.facts;
            if (!file.open_edges.empty()) {
                EXPECT_EQ(std::to_string(facts.without_area), file.without_area);
                std::set<uint>
                    points;  // the list counts sides from a vertex to itself as open edges
                for (const Face& face : scene.faces)
                    for (const auto& [u, v] : {std::pair(face.a, face.b), std::pair(face.b, face.c),
                                               std::pair(face.c, face.a)})
                        if (u == v)
                            points.insert(u);
                EXPECT_EQ(std::to_string(facts.open_edges + points.size()), file.open_edges);
                EXPECT_EQ(std::to_string(facts.nonmanifold_edges), file.nonmanifold_edges);
            }
            EXPECT_NE(file.outcome, "reject");
            what = "loaded";
        } catch (const Unavailable& error) {
            what = "refused";
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            EXPECT_TRUE(contains(error.what(), file.name));
            EXPECT_NE(file.outcome, "load") << error.what();
            std::cout << file.name << ": " << error.what() << '\n';
        }
        ++outcomes[file.outcome + ", " + what];
    }
    EXPECT_FALSE(outcomes.empty());
    for (const auto& [outcome, count] : outcomes)
        std::cout << count << " listed as " << outcome << '\n';
}

}  // namespace
}  // namespace bvhbench
