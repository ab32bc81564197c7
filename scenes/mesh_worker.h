// SPDX-License-Identifier: MIT
//
// assimp 5.2.5 crashes or hangs on many malformed files, so it runs in a process of its own: this program,
// started again with a hidden first argument. A process that has used PoCL cannot be forked, so it is
// spawned. Every main that may read a mesh file begins with
//
//     if (is_mesh_worker(argc, argv))
//         return mesh_worker_main(argc, argv);
#pragma once

#include <filesystem>
#include <optional>
#include <variant>

#include "scenes/catalog.h"
#include "scenes/formats/formats.h"

namespace bvhbench {

/// Whether this process was started by `read_in_worker`.
bool is_mesh_worker(int argc, char** argv);

/// Reads the file named by the arguments with assimp and writes it to standard output as a message. Returns the exit code.
/// Silences everything else that is written to standard output.
int mesh_worker_main(int argc, char** argv);

/// Whether assimp has a reader for files that end in `extension` (".gltf").
bool assimp_knows(const std::string& extension);

/// What assimp reads from `path`, each instance of a mesh an object, transformed by the nodes above it. Nothing is merged,
/// points and lines are passed over, and polygons are cut into fans.
/// Throws Unavailable when assimp refuses, crashes, or passes a limit of `library`.
FileMesh read_in_worker(const std::filesystem::path& path, const SceneLibrary& library);

/// What the worker sends back, in the byte order of the machine both run on:
///
///     "BVHMESH1"  'E'  text to the end                                              a refusal
///     "BVHMESH1"  'M'  points, faces, first face and count of each object, names    a mesh
///
/// where each list is its length in 64 bits and what it holds.
std::string mesh_message(const FileMesh& file);
std::string refusal_message(std::string_view why);

/// The mesh or the refusal in `message`; nothing if it is neither in full, as after a crash.
/// Says nothing of whether the mesh makes sense.
std::optional<std::variant<FileMesh, std::string>> decoded(std::string_view message);

}  // namespace bvhbench
