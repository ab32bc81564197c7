// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/mesh_worker.h"

namespace bvhbench {

/// Returns all bytes of a regular file. Throws Unavailable if it does not exist, is not a regular file, or cannot be read.
/// Requires `times` the file's size of free host memory first, for the bytes and for what the caller makes of them.
std::string file_bytes(const std::filesystem::path& path, std::uint64_t times = 1);

/// True if `read_mesh_file` can read files with this extension.
bool is_mesh_file(const std::filesystem::path& path);

/// True if files with this extension (".obj") are read by formats/, not by assimp.
bool is_read_here(const std::string& extension);

/// Reads a mesh file by its extension: .obj, .ply, .off, .stl, .gltf and .glb with the readers of formats/, other formats with assimp in a
/// worker process. Throws Unavailable.
FileMesh read_mesh_file(const std::filesystem::path& path, const SceneLibrary& library);

/// Moves the file's triangles and objects into `scene`, grouped (scenes/face_order.h), but not its points.
void take_mesh(Scene& scene, FileMesh&& file);

}  // namespace bvhbench
