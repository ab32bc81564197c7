// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/scene.h"

namespace bvhbench {

/// Where scenes come from and what reading one may cost.
struct SceneLibrary {
    std::filesystem::path data;  ///< --data, else BVHBENCH_DATA, else empty
    /// Of a process that reads a file, which gets no more than half of the host's memory either.
    std::size_t memory_limit_bytes = std::size_t{8} << 30;
    double time_limit_s = 120;             ///< for that process
    Doubles doubles = Doubles::recentred;  ///< what becomes of coordinates that floats cannot hold
    /// Told, in one line, what became of them; may be empty.
    std::function<void(const std::string& line)> tell = {};
};

/// The scene `text` asks for: a generator with its size ("torus:2880000"), one of
/// what moves with its size and maybe its number of frames ("cloth-ball:92000:94"), a data set by name ("bunny"), a
/// path to a mesh file, or "refine:SCENE:N".
///
/// Throws BadUsage when no scene is called so (lists the known), Unavailable when a file is not there, is
/// not what it should be, or holds something that is no scene (says what, in one sentence).
Scene load_scene(std::string_view text, const SceneLibrary& library);

/// Files and folders that loading the scene `text` may read; some of them need not be there.
std::vector<std::string> scene_files(std::string_view text, const SceneLibrary& library);

/// How many triangles the scene `text` will have, as far as its name tells; 0 if only loading it does.
///
/// Throws BadUsage when no scene is called so, as far as that can be told without loading it.
std::size_t triangles_said(std::string_view text);

/// Whether `text` is a generator's name, for which ":N" makes a scene of N triangles.
bool is_sized_generator(std::string_view text);

/// A line of `list scenes`.
struct SceneListing {
    std::string name;     ///< as typed, with N where a size goes
    std::string summary;  ///< what it is, how many triangles, whether its file was found
};
std::vector<SceneListing> list_scenes(const SceneLibrary& library);

/// The same, but where `text` is a data set whose own file is not there or is another edition: the first of its stand-ins
/// that is possible, with `stand_in_for` set. What stands in for a mesh has as many triangles; for a sequence, it is other
/// frames or a simulation of about its size, and how many triangles, objects and frames it has must be read from the scene.
Scene load_or_stand_in(std::string_view text, const SceneLibrary& library);

}  // namespace bvhbench
