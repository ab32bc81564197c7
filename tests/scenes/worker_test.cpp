// SPDX-License-Identifier: MIT
#include "scenes/mesh_worker.h"

#include "helpers.h"
#include "process/child.h"

namespace bvhbench {
namespace {

// Two instances of a square of two triangles, the second moved by 10 along x.
constexpr const char* dae =
    R"(<COLLADA version="1.4.1"><asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="a" count="15">0 0 0 1 0 0 1 1 0 0 1 0 9 9 9</float_array><technique_common><accessor source="#a" count="5" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 1 2 0 2 3</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s">
<node id="still"><instance_geometry url="#g"/></node><node id="moved"><translate>10 0 0</translate><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

using Worker = InFolder;

TEST_F(Worker, ReadsWhatAssimpReadsWithTransformsAndInstances)
{
    Listening library;
    const Scene scene = load_scene(folder.file("square.dae", dae), library);
    ASSERT_EQ(scene.triangle_count(), 4u);
    ASSERT_EQ(scene.frames[0].size(), 8u);  // shared within an instance, not between instances
    EXPECT_EQ(scene.reading.joined_vertices, 4u);
    EXPECT_TRUE(
        contains(library.told,
                 "its corners come without common vertices, and 4 of equal position were joined"));
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[1].name, "moved");
    EXPECT_EQ(scene.objects[1].first_face, 2u);
    EXPECT_EQ(scene.frames[0][5].x - scene.frames[0][1].x, 10.0f);
}

TEST_F(Worker, SaysWhyAssimpRefuses)
{
    const std::string message = refusal(folder.file("bad.dae", "{]"));
    EXPECT_TRUE(contains(message, "Unavailable: "));
    EXPECT_TRUE(contains(message, "bad.dae is not read: assimp says: "));
    EXPECT_EQ(message.find('\n'), message.npos);
}

TEST_F(Worker, IsEndedWhenItsTimeIsOver)
{
    SceneLibrary library;
    library.time_limit_s = 1e-4;  // no process starts this fast
    EXPECT_TRUE(refuses(folder.file("square.dae", dae),
                        "Unavailable: the reader took longer than 0.0001 s on ", library));
}

TEST_F(Worker, MayNotUseMoreMemoryThanItIsGiven)
{
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "address space is not limited under the address sanitizer";
#endif
    SceneLibrary library;
    library.memory_limit_bytes = 1 << 16;
    EXPECT_TRUE(refuses(folder.file("square.dae", dae), "Unavailable: ", library));
}

TEST(Process, TellsHowItEnded)
{
    const auto shell = [](const char* script, double limit) {
        return run_process({"/bin/sh", "-c", script}, limit, "COLOUR=blue");
    };
    EXPECT_EQ(spelled(shell("kill -SEGV $$", 600), 600), "crashed (signal 11)");
    EXPECT_EQ(spelled(shell("exit 7", 600), 600), "ended with exit code 7");
    EXPECT_EQ(spelled(shell("exec sleep 100", 0.05), 0.05), "took longer than 0.05 s");
    EXPECT_EQ(shell("echo $COLOUR; echo noise >&2", 600).output, "blue\n");
    EXPECT_THROW(run_process({"/nowhere/program"}, 1, "A=b"), Unavailable);
}

FileMesh triangle() { return {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {{"it", 0, 1}}}; }

TEST(Process, FindsWhatItIsGivenBeforeWhatWasThere)
{
    setenv("COLOUR", "red", 1);
    setenv("COLOURS", "all", 1);
    const ProcessEnd end = run_process(
        {"/usr/bin/python3", "-c", "import os; print(os.getenv('COLOUR'), os.getenv('COLOURS'))"},
        600, "COLOUR=blue");
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
