// SPDX-License-Identifier: MIT
#include "scenes/sequence.h"

#include "helpers.h"
#include "scenes/manifest.h"

namespace bvhbench {
namespace {

constexpr const char* mesh =
    "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 2\nproperty list uchar int vertex_indices\nproperty ushort "
    "object_id\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 1\n0 1 1\n3 0 1 2 0\n3 3 4 5 1\n";

std::string frame_bytes(std::size_t frames)
{
    std::vector<float> values(frames * 18);
    for (std::size_t k = 0; k < values.size(); ++k)
        values[k] = static_cast<float>(k);
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

using Sequence = InFolder;

TEST_F(Sequence, IsAMeshAndItsFrames)
{
    folder.file("mesh.ply", mesh);
    folder.file("frames.f32", frame_bytes(3));
    const Scene scene = load_scene(path(), {});
    ASSERT_EQ(scene.frames.size(), 3u);
    EXPECT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.frames[2][0].x, 36.0f);
}

TEST_F(Sequence, MustHoldWholeFrames)
{
    folder.file("mesh.ply", mesh);
    EXPECT_TRUE(refuses(path(), "frames.f32"));
    folder.file("frames.f32", frame_bytes(2).substr(1));
    EXPECT_TRUE(
        refuses(path(), "frames.f32 has 143 bytes, no whole number of frames of 6 vertices"));
    folder.file("frames.f32", "");
    EXPECT_TRUE(refuses(path(), "frames.f32 has 0 bytes"));
}

/// Writes a sequence of two frames with the given meta.json. Returns the folder.
std::string with_meta(const Folder& folder, const std::string& meta)
{
    folder.file("mesh.ply", mesh);
    folder.file("frames.f32", frame_bytes(2));
    folder.file("meta.json", meta);
    return folder.path().string();
}

/// Returns the mesh without an object_id.
std::string plain_mesh()
{
    std::string plain = mesh;
    plain.replace(plain.find("property ushort object_id\n"), 26, "");
    plain.replace(plain.find("3 0 1 2 0"), 9, "3 0 1 2");
    plain.replace(plain.find("3 3 4 5 1"), 9, "3 3 4 5");
    return plain;
}

TEST_F(Sequence, TakesNamesAndLabelsFromItsMeta)
{
    const std::string path = with_meta(folder, R"({"frames": 2, "vertices": 6, "triangles": 2,
"frame_labels": [5, "late"], "anything": {"else": [1, 2.5]},
"objects": [{"name": "cloth", "face_first": 0, "face_count": 1, "vertex_first": 0},
            {"name": "ball", "face_first": 1, "face_count": 1}]})");
    const Scene scene = load_scene(path, {});
    EXPECT_EQ(scene.objects[0].name, "cloth");
    EXPECT_EQ(scene.objects[1].name, "ball");
    EXPECT_EQ(scene.frame_labels, (std::vector<std::string>{"5", "late"}));
    EXPECT_TRUE(scene.has_meshes);
    EXPECT_EQ(load_scene(with_meta(folder, "{}"), {}).objects[1].name, "object 1");
}

TEST_F(Sequence, TakesObjectsFromItsMetaWhereTheMeshNamesNone)
{
    folder.file("mesh.ply", plain_mesh());
    folder.file("frames.f32", frame_bytes(2));
    EXPECT_EQ(load_scene(path(), {}).objects.size(), 1u);
    EXPECT_FALSE(load_scene(path(), {}).has_meshes);
    const auto table = [](const char* second) {
        return std::string(R"({"objects": [{"name": "a", "face_first": 0, "face_count": 1}, )"
                           R"({"name": "b", "face_first": )") +
               second + "}]}";
    };
    folder.file("meta.json", table(R"(1, "face_count": 1)"));
    EXPECT_EQ(load_scene(path(), {}).objects.size(), 2u);
    for (const char* wrong :
         {R"(0, "face_count": 1)", R"(1, "face_count": 2)", R"(1, "face_count": 0)"}) {
        folder.file("meta.json", table(wrong));
        EXPECT_TRUE(
            refuses(path(), "meta.json has objects that do not cover the mesh's triangles"));
    }
}

TEST_F(Sequence, LeavesTheObjectOfEachTriangleToTheMeshWhereItsMetaNamesNoFirst)
{
    std::string mixed = mesh;  // the object of id 1 comes first, and 0 behind it
    mixed.replace(mixed.find("3 0 1 2 0"), 9, "3 0 1 2 1");
    mixed.replace(mixed.find("3 3 4 5 1"), 9, "3 3 4 5 0");
    folder.file("mesh.ply", mixed);
    folder.file("frames.f32", frame_bytes(2));
    const auto loaded = [&](const std::string& second) {
        folder.file("meta.json",
                    R"({"objects": [{"id": 0, "name": "a", "face_first": null, "face_count": 1},
{"name": "b", "face_count": )" +
                        second + "}]}");
        return load_scene(path(), {});
    };
    const Scene scene = loaded("1");
    EXPECT_EQ(scene.objects[0].name, "a");
    EXPECT_EQ(scene.file_faces, (std::vector<uint>{1, 0}));
    EXPECT_THROW(loaded("2"), Unavailable);
    EXPECT_THROW(loaded(R"(1, "id": 5)"), Unavailable);
    folder.file("mesh.ply", plain_mesh());
    EXPECT_TRUE(refuses(path(), "without a face_first, and the mesh has no object_id"));
}

TEST_F(Sequence, RefusesAMetaThatDisagrees)
{
    EXPECT_EQ(refusal(with_meta(folder, "{}")), "loaded");
    const std::pair<const char*, const char*> wrong[] = {
        {"{", "meta.json is not JSON"},
        {"[]", "meta.json is no JSON object"},
        {R"({"frames": 3})", "meta.json says 3 frames, and there are 2"},
        {R"({"vertices": 5})", "meta.json says 5 vertices, and there are 6"},
        {R"({"triangles": -2})", "has no count 'triangles'"},
        {R"({"triangles": 9})", "meta.json says 9 triangles, and there are 2"},
        {R"({"frame_labels": [1]})", "has 1 frame labels for 2 frames"},
        {R"({"frame_labels": [1, 2.5]})", "neither text nor a whole number"},
        {R"({"objects": 1})", "'objects' that are no list"},
        {R"({"objects": [{"face_first": 0}]})", "an object without a name, number 0"},
        {R"({"objects": [3]})", "an object without a name, number 0"},
        {R"({"objects": [{"name": "a", "face_first": 0}]})", "no count 'face_count'"},
        {R"({"objects": [{"name": "a", "face_first": 0, "face_count": 1}]})",
         "has 1 objects, and the mesh has 2"},
        {R"({"objects": [{"name": "a", "face_first": 0, "face_count": 2},
                         {"name": "b", "face_first": 2, "face_count": 1}]})",
         "has an object, 'a', over 2 triangles from 0, and the mesh has 1 from 0"},
        {R"({"objects": [{"name": "a", "face_first": 0, "face_count": 1},
                         {"name": "b", "face_first": 0, "face_count": 1}]})",
         "has an object, 'b', over 1 triangles from 0, and the mesh has 1 from 1"},
    };
    for (const auto& [meta, message] : wrong)
        EXPECT_TRUE(refuses(with_meta(folder, meta), message));
}

TEST_F(Sequence, MayBeNumberedFilesWhosePartsAreObjects)
{
    const std::string faces = "f 1 2 3\nf 4 5 6\n";
    const auto points = [](const std::string& z) {
        std::string text = "v 5 0 0\nv 6 0 0\nv 5 1 0\n";
        for (const char* corner : {"v 0 0 ", "v 1 0 ", "v 0 1 "})
            text.append(corner).append(z).append("\n");
        return text;
    };
    folder.file("cloth10.obj", points("10") + faces);
    folder.file("cloth9.obj", points("9") + faces);
    folder.file("readme1.txt", "not a frame");
    const Scene scene = load_scene(path(), {});
    ASSERT_EQ(scene.frames.size(), 2u);
    EXPECT_EQ(scene.frames[0][3].z, 9.0f);  // sorted by number, not by name
    EXPECT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.frame_labels, (std::vector<std::string>{"9", "10"}));
    EXPECT_FALSE(scene.has_meshes);  // components were found, but no names

    folder.file("cloth11.obj", points("11") + "f 1 3 2\nf 4 5 6\nf 1 2 4\n");
    EXPECT_TRUE(refuses(path(), "cloth11.obj has other triangles than "));
    SceneLibrary any;
    any.any_topology = true;
    const Scene changing = load_scene(path(), any);
    ASSERT_EQ(changing.frame_count(), 3u);
    EXPECT_EQ(changing.with_frame(1).faces.size(), 2u);
    EXPECT_EQ(changing.with_frame(1).frames[0][3].z, 10.0f);
    EXPECT_EQ(changing.with_frame(2).faces.size(), 3u);
    EXPECT_EQ(changing.with_frame(2).objects.size(), 1u);
    EXPECT_NE(changing.with_frame(2).content_hash, changing.with_frame(1).content_hash);
}

TEST_F(Sequence, RefusesATriangleOfAVertexThatIsNotThere)
{
    folder.file("f1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    EXPECT_TRUE(refuses(path(), "f1.obj has a triangle, 0, with vertex 8 of 3"));
}

TEST_F(Sequence, PassesOverFilesOfAnotherFormat)
{
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    folder.file("scan_1.obj", text);
    folder.file("scan_1.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_TRUE(refuses(path(), "has as many frames in .obj as in .off"));
    std::filesystem::remove(folder.path() / "scan_1.off");
    for (const char* other : {"meta_3.xml", "meta_4.xml", "meta_5.xml", ".scan_7.obj"})
        folder.file(other, "<xml/>");
    folder.file("scan_2.obj", text);
    Listening library;
    EXPECT_EQ(load_scene(path(), library).frames.size(), 2u);
    EXPECT_TRUE(contains(library.told,
                         "its frames are the 2 files in .obj, and 3 in .xml are passed over"));
}

TEST_F(Sequence, IsNotAnyFolder)
{
    EXPECT_TRUE(refuses(path(), "has neither mesh.ply and frames.f32 nor"));
}

TEST(DataSets, ThatAreHereHoldWhatTheManifestSays)
{
    const SceneLibrary library{data_folder()};
    int found = 0;
    for (const ManifestEntry& entry : manifest()) {
        if (entry.kind == ManifestEntry::Kind::queries || located(entry, library.data).empty())
            continue;
        ++found;
        SCOPED_TRACE(entry.name);
        const Scene scene = load_scene(entry.name, library);  // throws if a count differs
        EXPECT_EQ(scene.triangle_count(), entry.triangles);
        if (entry.objects != 0) {
            EXPECT_EQ(scene.objects.size(), entry.objects);
        }
    }
    std::cout << found << " data sets found in '" << library.data.string() << "'\n";
}

}  // namespace
}  // namespace bvhbench
