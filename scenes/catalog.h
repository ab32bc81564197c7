// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/scene.h"

namespace bvhbench {

/// Sources of scenes, and limits on reading one.
struct SceneLibrary {
    std::filesystem::path data;  ///< --data, else BVHBENCH_DATA, else empty
    /// Memory limit of a process that reads a file. The process also gets at most half of the host's free memory.
    std::size_t memory_limit_bytes = std::size_t{8} << 30;
    double time_limit_s = 120;             ///< time limit of that process
    Doubles doubles = Doubles::recentred;  ///< how coordinates that floats cannot hold are rounded
    bool weld = false;                     ///< whether vertices of equal position are joined
    bool any_topology = false;  ///< whether frames may differ in their triangles (Scene::later)
    /// Called with one line of text that describes such a rounding, or what surprises about a file; may be empty.
    std::function<void(const std::string& line)> tell = {};
};

/// Loads the scene called `text`: a generator with its size ("torus:2880000"), a moving generator with its size and optionally
/// its number of frames ("cloth-ball:92000:94"), a data set by name ("bunny"), a path to a mesh file, or "refine:SCENE:N". Counts
/// may also be written as "100k", "2.88M" or "1e5".
///
/// Throws BadUsage, listing the known scenes, if no scene has this name. Throws Unavailable, with one sentence that gives the
/// reason, if a file is missing, malformed, or holds something that is not a valid scene.
Scene load_scene(std::string_view text, const SceneLibrary& library);

/// Some consecutive triangles of a scene's first frame.
struct ScenePart {
    MeshRun mesh;
    FaceRange run;                ///< among all triangles
    std::uint64_t triangles = 0;  ///< of the scene
};

/// Makes or reads part `part` of `parts` of the scene `text`, without the others; parts have about equal sizes, in order. Nothing if
/// the scene must be loaded whole: other files than binary PLY (scenes/formats/ply_parts.h), data sets by name, scenes derived from
/// others, and generators that make no runs. Of a file, only what the part uses is checked. Throws as load_scene does.
std::optional<ScenePart> load_part(std::string_view text, uint part, uint parts);

/// Returns the name of the scene `text` with counts in digits, the same for every way to write them: "torus:100000" for
/// "torus:100k". What is no count stays as it is.
std::string scene_name(std::string_view text);

/// Returns the files and folders that loading the scene `text` may read; some of them need not exist.
std::vector<std::string> scene_files(std::string_view text, const SceneLibrary& library);

/// Returns the number of triangles that the name `text` says; 0 if only loading the scene tells.
///
/// Throws BadUsage if no scene can have this name, as far as that is known without loading it.
std::size_t triangles_in_name(std::string_view text);

/// True if `text` is the name of a generator, for which ":N" makes a scene of N triangles.
bool is_sized_generator(std::string_view text);

/// One line of `list scenes`.
struct SceneListing {
    std::string name;     ///< the name as typed, with N in place of a size
    std::string summary;  ///< description, number of triangles, and whether the file was found
};
std::vector<SceneListing> list_scenes(const SceneLibrary& library);

/// As load_scene. If `text` is a data set whose file is missing or is another edition, loads the first possible of its
/// stand-ins and sets `stand_in_for`. The stand-in of a mesh has the same number of triangles. The stand-in of a sequence is
/// other frames or a simulation of about its size; its numbers of triangles, objects and frames must be read from the scene.
Scene load_or_stand_in(std::string_view text, const SceneLibrary& library);

}  // namespace bvhbench
