// SPDX-License-Identifier: MIT
//
// assimp 5.2.5 crashes or hangs on many malformed files, so it runs in a separate process: this program, started again with a
// hidden first argument. The process is spawned, because one that has used PoCL cannot be forked. Every main that may read a
// mesh file begins with
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

/// True if this process was started by `read_in_worker`.
bool is_mesh_worker(int argc, char** argv);

/// Reads the file named by the arguments with assimp and writes it to standard output as a message. Discards everything else
/// that is written to standard output. Returns the exit code.
int mesh_worker_main(int argc, char** argv);

/// True if assimp has a reader for files with this extension (".gltf").
bool assimp_knows(const std::string& extension);

/// Reads `path` with assimp. Each instance of a mesh becomes an object, transformed by the nodes above it. In a mesh whose corners
/// have no vertex in common, those of equal position become one, across its materials; vertices that no face names are left out; points and lines are
/// skipped. Throws Unavailable if assimp refuses the file,
/// crashes, or exceeds a limit of `library`.
FileMesh read_in_worker(const std::filesystem::path& path, const SceneLibrary& library);

/// Encodes the worker's answer, in the byte order of the machine:
///
///     "BVHMESH2"  'E'  text to the end                                                       a refusal
///     "BVHMESH2"  'M'  points, faces, first face and count of each object, names, Reading    a mesh
///
/// Each list is its length in 64 bits, followed by its elements.
std::string mesh_message(const FileMesh& file);
std::string refusal_message(std::string_view why);

/// Decodes the mesh or the refusal in `message`; nothing if the message is incomplete, as after a crash. Does not check that
/// the mesh is valid.
std::optional<std::variant<FileMesh, std::string>> decoded(std::string_view message);

}  // namespace bvhbench
