// SPDX-License-Identifier: MIT
#include "scenes/mesh_file.h"

#include <algorithm>
#include <fstream>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "scenes/face_order.h"
#include "scenes/formats/assimp_faults.h"

namespace bvhbench {
namespace {

using Reader = FileMesh (*)(std::string_view bytes, const std::string& name);

/// Bytes of mesh per byte of its file. A vertex in doubles, as a float, and once more while arrays grow takes about three bytes
/// per byte of text, in addition to the text. Files of short numbers that need more hit RLIMIT_DATA.
constexpr std::uint64_t bytes_a_file_byte = 4;

std::string lower_extension(const std::filesystem::path& path)
{
    return lower_case(path.extension().string());
}

/// Returns the reader for this extension; nullptr for formats that assimp has to read.
Reader plain_reader(const std::string& extension)
{
    return extension == ".obj"   ? read_obj
           : extension == ".off" ? read_off
           : extension == ".ply" ? read_ply
           : extension == ".stl" ? read_stl
                                 : nullptr;
}

bool is_gltf(const std::string& extension) { return extension == ".gltf" || extension == ".glb"; }

void check_is_file(const std::filesystem::path& path)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        throw Unavailable("there is no file " + path.string());
    if (error)
        throw Unavailable(path.string() + " cannot be read: " + error.message());
    if (!std::filesystem::is_regular_file(status))
        throw Unavailable(path.string() + " is not a file");
}

/// Throws Unavailable for a triangle that names a vertex that is not there. OBJ's may come before their vertices.
void check_corners(const Mesh& mesh, const std::string& name)
{
    for (std::size_t k = 0; k < mesh.faces.size(); ++k)
        for (const uint corner : {mesh.faces[k].a, mesh.faces[k].b, mesh.faces[k].c})
            if (corner >= mesh.points.size())
                throw Unavailable(name + " has a triangle, " + std::to_string(k) +
                                  ", with vertex " + std::to_string(corner) + " of " +
                                  std::to_string(mesh.points.size()));
}

}  // namespace

std::string file_bytes(const std::filesystem::path& path, std::uint64_t times)
{
    check_is_file(path);
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file)
        throw Unavailable(path.string() + " cannot be read");
    const auto size = static_cast<std::uint64_t>(file.tellg());
    require_host_memory("reading " + in_quotes(path.string()), times * size);
    std::string bytes(size, '\0');
    file.seekg(0);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file)
        throw Unavailable(path.string() + " cannot be read");
    return bytes;
}

bool is_read_here(const std::string& extension)
{
    return plain_reader(extension) != nullptr || is_gltf(extension);
}

bool is_mesh_file(const std::filesystem::path& path)
{
    const std::string extension = lower_extension(path);
    return is_read_here(extension) || assimp_knows(extension);
}

FileMesh read_mesh_file(const std::filesystem::path& path, const SceneLibrary& library)
{
    check_is_file(path);
    const std::string extension = lower_extension(path);
    FileMesh file;
    if (const Reader read = plain_reader(extension)) {
        file = read(file_bytes(path, bytes_a_file_byte), path.string());
    } else if (is_gltf(extension)) {
        file = read_gltf(file_bytes(path, bytes_a_file_byte), path.string(),
                         [&](const std::string& beside) {
                             return file_bytes(path.parent_path() / beside, bytes_a_file_byte);
                         });
    } else if (assimp_knows(extension)) {
        if (const std::string fault = assimp_fault(file_bytes(path, bytes_a_file_byte), extension);
            !fault.empty())
            throw Unavailable(path.string() + " is not read: " + fault);
        file = read_in_worker(path, library);
    } else {
        throw Unavailable(path.string() + " is of a format that is not read, '" + extension + "'");
    }
    if (file.mesh.faces.empty())
        throw Unavailable(path.string() + " has no triangles");
    check_corners(file.mesh, path.string());
    cut_polygons(file, path.string());
    return file;
}

void take_mesh(Scene& scene, FileMesh&& file)
{
    scene.faces = std::move(file.mesh.faces);
    scene.objects = std::move(file.objects);
    scene.object_ids = std::move(file.object_ids);
    scene.has_meshes = !scene.objects.empty();
    scene.groups = std::move(file.groups);
    scene.group_of_face = std::move(file.group_of_face);
    scene.reading = std::move(file.reading);
    if (!file.object_of_face.empty())
        group_faces(scene, file.object_of_face);
}

}  // namespace bvhbench
