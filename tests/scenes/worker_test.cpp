// SPDX-License-Identifier: MIT
#include "scenes/mesh_worker.h"

#include "helpers.h"
#include "scenes/worker/process.h"

namespace bvhbench {
namespace {

// Two instances of a square of two triangles, the second moved by 10 along x.
constexpr const char* gltf =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"mesh": 0, "name": "still"}, {"mesh": 0, "name": "moved", "translation": [10, 0, 0]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
"accessors": [
 {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
 {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
"buffers": [{"byteLength": 60, "uri": "square.bin"}]})";

std::string square_bytes()
{
    const float points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::uint16_t corners[] = {0, 1, 2, 0, 2, 3};
    std::string bytes(reinterpret_cast<const char*>(points), sizeof points);
    return bytes.append(reinterpret_cast<const char*>(corners), sizeof corners);
}

TEST(Worker, ReadsWhatAssimpReadsWithTransformsAndInstances)
{
    const Folder folder;
    folder.file("square.bin", square_bytes());
    const Scene scene = load_scene(folder.file("square.gltf", gltf), {});
    ASSERT_EQ(scene.triangle_count(), 4u);
    ASSERT_EQ(scene.frames[0].size(), 8u);  // shared within an instance, not between instances
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[1].name, "moved");
    EXPECT_EQ(scene.objects[1].first_face, 2u);
    EXPECT_EQ(scene.frames[0][5].x - scene.frames[0][1].x, 10.0f);
}

TEST(Worker, SaysWhyAssimpRefuses)
{
    const Folder folder;
    const std::string message = refusal(folder.file("bad.gltf", "{]"));
    EXPECT_TRUE(contains(message, "Unavailable: "));
    EXPECT_TRUE(contains(message, "bad.gltf is not read: assimp says: "));
    EXPECT_EQ(message.find('\n'), message.npos);
}

TEST(Worker, IsEndedWhenItsTimeIsOver)
{
    const Folder folder;
    folder.file("square.bin", square_bytes());
    SceneLibrary library;
    library.time_limit_s = 1e-4;  // no process starts this fast
    EXPECT_TRUE(contains(refusal(folder.file("square.gltf", gltf), library),
                         "Unavailable: the reader took longer than 0.0001 s on "));
}

TEST(Worker, MayNotUseMoreMemoryThanItIsGiven)
{
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "address space is not limited under the address sanitizer";
#endif
    const Folder folder;
    folder.file("square.bin", square_bytes());
    SceneLibrary library;
    library.memory_limit_bytes = 1 << 16;
    EXPECT_TRUE(contains(refusal(folder.file("square.gltf", gltf), library), "Unavailable: "));
}

TEST(Process, TellsHowItEnded)
{
    const auto shell = [](const char* script, double limit) {
        return run_process({"/bin/sh", "-c", script}, limit, "COLOUR=blue");
    };
    EXPECT_EQ(spelled(shell("kill -SEGV $$", 20), 20), "crashed (signal 11)");
    EXPECT_EQ(spelled(shell("exit 7", 20), 20), "ended with exit code 7");
    EXPECT_EQ(spelled(shell("exec sleep 100", 0.05), 0.05), "took longer than 0.05 s");
    EXPECT_EQ(shell("echo $COLOUR; echo noise >&2", 20).output, "blue\n");
    EXPECT_THROW(run_process({"/nowhere/program"}, 1, "A=b"), Unavailable);
}

FileMesh triangle() { return {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {{"it", 0, 1}}}; }

TEST(Process, FindsWhatItIsGivenBeforeWhatWasThere)
{
    setenv("COLOUR", "red", 1);
    setenv("COLOURS", "all", 1);
    const ProcessEnd end = run_process(
        {"/usr/bin/python3", "-c", "import os; print(os.getenv('COLOUR'), os.getenv('COLOURS'))"},
        20, "COLOUR=blue");
    unsetenv("COLOUR");
    unsetenv("COLOURS");
    EXPECT_EQ(end.output, "blue all\n");
}

TEST(Message, IsNothingWhenCutOrChanged)
{
    const std::string whole = mesh_message(triangle());
    EXPECT_TRUE(decoded(whole));
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_FALSE(decoded(whole.substr(0, size))) << size;
    EXPECT_FALSE(decoded(whole + "x"));
    std::string counts = whole;
    counts[9 + 7] = '\x7f';  // an implausible number of points
    EXPECT_FALSE(decoded(counts));
}

}  // namespace
}  // namespace bvhbench
