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

TEST(Sequence, IsAMeshAndItsFrames)
{
    const Folder folder;
    folder.file("mesh.ply", mesh);
    folder.file("frames.f32", frame_bytes(3));
    const Scene scene = load_scene(folder.path().string(), {});
    ASSERT_EQ(scene.frames.size(), 3u);
    EXPECT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.frames[2][0].x, 36.0f);
}

TEST(Sequence, MustHoldWholeFrames)
{
    const Folder folder;
    folder.file("mesh.ply", mesh);
    EXPECT_TRUE(contains(refusal(folder.path().string()), "frames.f32"));
    folder.file("frames.f32", frame_bytes(2).substr(1));
    EXPECT_TRUE(contains(refusal(folder.path().string()),
                         "frames.f32 has 143 bytes, no whole number of frames of 6 vertices"));
    folder.file("frames.f32", "");
    EXPECT_TRUE(contains(refusal(folder.path().string()), "frames.f32 has 0 bytes"));
}

TEST(Sequence, MayBeNumberedFilesWhosePartsAreObjects)
{
    const Folder folder;
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
    const Scene scene = load_scene(folder.path().string(), {});
    ASSERT_EQ(scene.frames.size(), 2u);
    EXPECT_EQ(scene.frames[0][3].z, 9.0f);  // by number, not by name
    EXPECT_EQ(scene.objects.size(), 2u);

    folder.file("cloth11.obj", points("11") + "f 1 3 2\nf 4 5 6\n");
    EXPECT_TRUE(contains(refusal(folder.path().string()), "cloth11.obj has other triangles than "));
}

TEST(Sequence, IsNotAnyFolder)
{
    const Folder folder;
    EXPECT_TRUE(
        contains(refusal(folder.path().string()), "has neither mesh.ply and frames.f32 nor"));
}

TEST(DataSets, ThatAreHereHoldWhatTheManifestSays)
{
    const SceneLibrary library{data_folder(), 0, 0};
    int found = 0;
    for (const ManifestEntry& entry : manifest()) {
        if (located(entry, library.data).empty())
            continue;
        ++found;
        SCOPED_TRACE(entry.set.name);
        const Scene scene = load_scene(entry.set.name, library);  // throws when a count differs
        EXPECT_EQ(scene.triangle_count(), entry.set.triangles);
        if (entry.objects != 0) {
            EXPECT_EQ(scene.objects.size(), entry.objects);
        }
    }
    std::cout << found << " data sets found in '" << library.data.string() << "'\n";
}

}  // namespace
}  // namespace bvhbench
