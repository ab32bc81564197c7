// SPDX-License-Identifier: MIT
//
// Data sets with the counts of a separate program, and loops over them for the tests that compare with these counts.
#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "geometry/hash.h"
#include "scenes/catalog.h"
#include "scenes/face_order.h"
#include "tests/folder.h"

namespace bvhbench {

constexpr auto no_data_sets = "BVHBENCH_DATA is not set: nothing is compared with the data sets";

inline nlohmann::json read_json(const std::filesystem::path& path)
{
    std::ifstream in(path);
    return nlohmann::json::parse(in);
}

/// A mesh as its file has it.
struct DataSetMesh {
    std::vector<Point> points;
    std::vector<Face> faces;
    std::vector<uint> objects;  ///< object of each face
};

inline DataSetMesh in_file(const Scene& scene, std::size_t frame = 0)
{
    const std::vector<std::int64_t> objects = objects_in_file(scene);
    return {scene.frames.at(frame), faces_in_file(scene), {objects.begin(), objects.end()}};
}

/// Calls compare(mesh, reference) for every static mesh that is present and has at most `most_triangles` triangles.
template <class Compare>
void compare_static_meshes(std::size_t most_triangles, const Compare& compare)
{
    std::size_t compared = 0;
    const nlohmann::json references = read_json(data_folder() / "static/reference.json");
    for (const auto& [name, reference] : references.items()) {
        SCOPED_TRACE(name);
        const std::filesystem::path path = data_folder() / "static" / name;
        if (reference["tris"] > most_triangles || !std::filesystem::exists(path)) {
            std::cout << "large or not there, not compared: " << name << '\n';
            continue;
        }
        compare(in_file(load_scene(path.string(), {})), reference);
        ++compared;
    }
    EXPECT_GT(compared, 0u);
}

/// Calls compare(mesh, reference, is_last) for every frame with a reference; is_last is true for a sequence's last frame.
template <class Compare>
void compare_frames(const Compare& compare)
{
    std::size_t compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data_folder() / "dynamic")) {
        if (!std::filesystem::exists(entry.path() / "meta.json"))
            continue;  // nobody counted its pairs
        SCOPED_TRACE(entry.path().filename().string());
        const nlohmann::json meta = read_json(entry.path() / "meta.json");
        const Scene scene = load_scene(entry.path().string(), {});
        for (const nlohmann::json& reference : meta["reference"]) {
            SCOPED_TRACE("frame " + reference["index"].dump());
            compare(in_file(scene, reference["index"]), reference,
                    reference == meta["reference"].back());
            ++compared;
        }
    }
    EXPECT_GT(compared, 0u);
}

}  // namespace bvhbench
