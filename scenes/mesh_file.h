// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/mesh_worker.h"

namespace bvhbench {

/// All bytes of a regular file. Throws Unavailable if it is not there, is no file, or cannot be read. Before it reads, it asks
/// for `times` the file's size of the host's memory, for the bytes and for what is made of them.
std::string file_bytes(const std::filesystem::path& path, std::uint64_t times = 1);

/// Whether `read_mesh_file` knows the format, by the extension.
bool is_mesh_file(const std::filesystem::path& path);

/// What a mesh file holds, by its extension: .obj, .ply, .off and .stl by the readers of formats/, what
/// else assimp knows by assimp in a worker. Throws Unavailable.
FileMesh read_mesh_file(const std::filesystem::path& path, const SceneLibrary& library);

/// Makes the file's triangles and objects the scene's, grouped (scenes/face_order.h). Not its points.
void take_mesh(Scene& scene, FileMesh&& file);

}  // namespace bvhbench
