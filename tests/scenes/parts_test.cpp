// SPDX-License-Identifier: MIT
//
// Parts of binary PLY files and of frames are those of the whole; what cannot be read in parts is read whole.
#include "helpers.h"
#include "kinds.h"

namespace bvhbench {
namespace {

/// A strip of `triangles` triangles, with properties that are not read before, between and behind those that are.
struct Strip {
    uint triangles = 100;
    std::string coordinate = "float", format = "binary_little_endian";
    uint wrong_face = 0xffffffffu;  ///< names a vertex that there is not
    uint endless_point = 0xffffffffu;
    unsigned char corners = 3;  ///< of the first face, as its list says

    std::string bytes() const
    {
        std::string all = "ply\nformat " + format + " 1.0\nelement other 2\nproperty short s\n";
        all += "element face " + std::to_string(triangles) +
               "\nproperty uchar flag\nproperty list uchar int vertex_indices\nproperty int "
               "object_id\n";
        all += "element vertex " + std::to_string(triangles + 2) + "\nproperty " + coordinate +
               " y\nproperty uchar red\nproperty " + coordinate + " x\nproperty " + coordinate +
               " z\nend_header\n";
        append<std::int32_t>(all, 0);
        for (uint k = 0; k < triangles; ++k) {
            append<unsigned char>(all, 1);
            append<unsigned char>(all, k == 0 ? corners : 3);
            for (const uint corner : {k + 2, k, k == wrong_face ? triangles + 2 : k + 1})
                append(all,
                       triangles + 1 - corner);  // descending, so later faces have smaller ones
            append<std::int32_t>(all, static_cast<std::int32_t>(k % 3));
        }
        for (uint k = 0; k < triangles + 2; ++k) {
            const float inverse = k == endless_point ? 0.0f : static_cast<float>(k) + 1.0f;
            const float at[] = {1.0f / inverse, -0.0f, static_cast<float>(k)};
            for (int axis = 0; axis < 3; ++axis) {
                if (axis == 1)
                    append<unsigned char>(all, 255);
                if (coordinate == "float")
                    append(all, at[axis]);
                else
                    append(all, static_cast<double>(at[axis]));
            }
        }
        return all;
    }
};

using Parts = InFolder;

TEST_F(Parts, OfABinaryPlyAreThoseOfTheWhole)
{
    for (const uint triangles : {1u, 2u, 100u}) {
        const std::string path = folder.file("strip.ply", Strip{triangles}.bytes());
        for (const uint parts : {1u, 3u, 7u})
            hold_parts(path, parts, true);
    }
}

TEST_F(Parts, OfFramesHaveThePointsOfTheFirst)
{
    const uint points = 102;
    Strip strip;
    strip.coordinate = "double";  // not read
    folder.file("mesh.ply", strip.bytes());
    std::string frames;
    for (uint k = 0; k < 2 * 3 * points; ++k)
        append(frames, static_cast<float>(k) / 3);
    folder.file("frames.f32", frames);
    hold_parts(folder.path(), 4, true);
    folder.file("frames.f32", frames + "x");
    EXPECT_FALSE(load_part(path(), 0, 2));
}

TEST_F(Parts, AreNotReadWhereRecordsDiffer)
{
    const std::string good = Strip{}.bytes();
    Strip doubles, big;
    doubles.coordinate = "double";
    big.format = "binary_big_endian";
    for (const std::string& bytes :
         {doubles.bytes(), big.bytes(), good + "x", good.substr(0, good.size() - 1)})
        EXPECT_FALSE(load_part(folder.file("a.ply", bytes), 0, 2));
    EXPECT_TRUE(load_part(folder.file("a.ply", good), 0, 2));
    EXPECT_FALSE(load_part(folder.file("a.obj", "v 0 0 0\n"), 0, 2));
    EXPECT_FALSE(load_part(path() + "/none.ply", 0, 2));
}

TEST_F(Parts, SayWhatIsWrongWithThem)
{
    const auto refusal = [&](const Strip& strip, uint part) {
        return refusal_of([&] { load_part(folder.file("b.ply", strip.bytes()), part, 2); });
    };
    Strip wrong, endless, polygon;
    wrong.wrong_face = 70;
    endless.endless_point = 80;
    polygon.corners = 4;
    EXPECT_TRUE(contains(refusal(wrong, 1), "b.ply, face 70 of 100: it names vertex "));
    EXPECT_EQ(refusal(wrong, 0), "");
    EXPECT_TRUE(contains(refusal(endless, 0), "b.ply has a vertex, 80, that is not finite"));
    EXPECT_TRUE(contains(refusal(polygon, 0), "b.ply, face 0 of 100: it is no triangle"));
}

}  // namespace
}  // namespace bvhbench
