// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <set>

#include "scenes/catalog.h"
#include "scenes/face_order.h"
#include "tests/case_name.h"
#include "tests/folder.h"
#include "tests/refusal.h"

namespace bvhbench {

/// Tests with a temporary folder.
class InFolder : public testing::Test {
protected:
    /// Loads a file that it writes.
    Scene loaded(const std::string& name, std::string_view bytes) const
    {
        return load_scene(folder.file(name, bytes), {});
    }

    std::string path() const { return folder.path().string(); }

    const Folder folder;
};

/// Returns the message with which loading `text` is refused, after its class: "BadUsage: no scene is called ...".
inline std::string refusal(std::string_view text, const SceneLibrary& library = {})
{
    try {
        load_scene(text, library);
    } catch (const BadUsage& error) {
        return std::string("BadUsage: ") + error.what();
    } catch (const Unavailable& error) {
        return std::string("Unavailable: ") + error.what();
    }
    return "loaded";
}

/// Whether loading `text` is refused in a message with these words.
inline testing::AssertionResult refuses(std::string_view text, const std::string& words,
                                        const SceneLibrary& library = {})
{
    return contains(refusal(text, library), words) << " of " << text;
}

/// A library that keeps what loading tells.
struct Listening : SceneLibrary {
    std::string told;
    Listening()
    {
        tell = [this](const std::string& line) { told += line; };
    }
    Listening(const Listening&) = delete;
};

/// Compares all parts of a scene with the whole: its triangles in the order of the file, with the vertices that they name, and with
/// no others if `no_others`.
inline void hold_parts(const std::string& name, uint parts, bool no_others = false)
{
    const Scene whole = load_scene(name, {});
    const std::vector<Face> faces = faces_in_file(whole);
    const std::vector<Point>& points = whole.frames.front();
    uint next = 0;
    for (uint k = 0; k < parts; ++k) {
        const auto part = load_part(name, k, parts);
        ASSERT_TRUE(part) << name;
        const auto& mesh = part->mesh;
        EXPECT_EQ(part->triangles, faces.size());
        EXPECT_EQ(mesh.mesh_points, points.size()) << name;
        EXPECT_EQ(part->run.first, next);
        ASSERT_EQ(mesh.faces.size(), part->run.count);
        ASSERT_EQ(mesh.points.size(), mesh.vertices.size());
        std::set<uint> named;
        for (const Face& face : mesh.faces) {
            named.insert({face.a, face.b, face.c});
            EXPECT_EQ(0, std::memcmp(&face, &faces[next++], sizeof face));
        }
        EXPECT_TRUE(std::ranges::includes(mesh.vertices, named)) << name;
        EXPECT_TRUE(!no_others || mesh.vertices.size() == named.size());
        for (std::size_t i = 0; i < mesh.points.size(); ++i)
            EXPECT_EQ(0, std::memcmp(&mesh.points[i], &points[mesh.vertices[i]], sizeof(Point)));
    }
    EXPECT_EQ(next, faces.size());
}

/// Returns the box around object `k` in a frame.
inline Aabb object_box(const Scene& scene, std::size_t frame, std::size_t k)
{
    const auto& [name, first, count] = scene.objects[k];
    return box_around(scene.frames[frame], std::span(scene.faces).subspan(first, count));
}

/// Returns how many pairs of objects have boxes that overlap in a frame.
inline std::size_t overlapping_objects(const Scene& scene, std::size_t frame)
{
    std::vector<Aabb> boxes;
    std::size_t overlapping = 0;
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
        const Aabb box = object_box(scene, frame, k);
        overlapping +=
            std::ranges::count_if(boxes, [&](Aabb other) { return overlap(box, other); });
        boxes.push_back(box);
    }
    return overlapping;
}

/// True if all points are equal bit for bit.
inline bool same_points(const std::vector<Point>& a, const std::vector<Point>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Point)) == 0;
}

}  // namespace bvhbench
