// SPDX-License-Identifier: MIT
#include "scenes/sequence.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "geometry/error.h"
#include "scenes/face_order.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

std::vector<std::vector<Point>> read_frames(const std::filesystem::path& path, std::size_t vertices)
{
    const std::string bytes = file_bytes(path, 2);  // twice: bytes and points
    const std::size_t frame_size = vertices * sizeof(Point);
    if (bytes.empty() || bytes.size() % frame_size != 0)
        throw Unavailable(path.string() + " has " + std::to_string(bytes.size()) +
                          " bytes, no whole number of frames of " + std::to_string(vertices) +
                          " vertices");
    std::vector<std::vector<Point>> frames(bytes.size() / frame_size);
    for (std::size_t k = 0; k < frames.size(); ++k) {
        frames[k].resize(vertices);
        std::memcpy(frames[k].data(), bytes.data() + k * frame_size, frame_size);
    }
    return frames;
}

/// Returns the last number in a file's name, by which frames are ordered; nothing if there is none. Throws Unavailable if the
/// number is too large.
std::optional<std::int64_t> frame_number(const std::filesystem::path& path)
{
    const std::string stem = path.stem().string();
    const std::size_t end = stem.find_last_of("0123456789");
    if (end == stem.npos)
        return std::nullopt;
    const std::size_t before = stem.find_last_not_of("0123456789", end);
    const std::size_t begin = before == stem.npos ? 0 : before + 1;
    const auto number = parse_integer(std::string_view(stem).substr(begin, end + 1 - begin));
    if (!number)
        throw Unavailable(path.string() +
                          " has a frame number above 2^63 - 1, the largest there is");
    return number;
}

/// The mesh files of a folder, by their numbers.
using NumberedFiles = std::map<std::int64_t, std::filesystem::path>;

NumberedFiles numbered_files(const std::filesystem::path& folder)
{
    NumberedFiles files;
    std::error_code error;
    const std::filesystem::directory_iterator entries(folder, error);
    if (error)
        throw Unavailable(folder.string() + " cannot be read: " + error.message());
    for (const auto& entry : entries) {
        // Any other file that is named like a frame counts as one; reading it gives the reason why it is not valid.
        if (!is_mesh_file(entry.path()) || entry.is_directory(error))
            continue;
        const auto number = frame_number(entry.path());
        if (!number)
            continue;
        if (!files.emplace(*number, entry.path()).second)
            throw Unavailable(folder.string() + " has two files for frame " +
                              std::to_string(*number));
    }
    return files;
}

bool same(const std::vector<Face>& a, const std::vector<Face>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Face)) == 0;
}

/// Reads the files again, for their vertices in doubles. Few sequences need this, so the others use no memory for it.
std::vector<std::vector<WidePoint>> wide_frames(const NumberedFiles& files,
                                                const SceneLibrary& library)
{
    std::vector<std::vector<WidePoint>> frames;
    for (const auto& [number, path] : files) {
        FileMesh file = read_mesh_file(path, library);
        if (!file.has_doubles || file.wide.empty())
            for (const Point& point : file.mesh.points)
                file.wide.push_back({point.x, point.y, point.z});
        frames.push_back(std::move(file.wide));
    }
    return frames;
}

Scene read_numbered(const std::filesystem::path& folder, const SceneLibrary& library)
{
    const NumberedFiles files = numbered_files(folder);
    if (files.empty())
        throw Unavailable(folder.string() +
                          " has neither mesh.ply and frames.f32 nor numbered mesh files");
    Scene scene;
    FileMesh first;
    bool floats_hold = true;
    for (const auto& [number, path] : files) {
        FileMesh file = read_mesh_file(path, library);
        floats_hold = floats_hold && file.floats_hold;
        if (!scene.frames.empty() && !same(first.mesh.faces, file.mesh.faces))
            throw Unavailable(path.string() + " has other triangles than " +
                              files.begin()->second.string() + ", and frames share theirs");
        scene.frames.push_back(std::move(file.mesh.points));
        if (scene.frames.size() == 1)
            first = std::move(file);
        scene.frame_labels.push_back(std::to_string(number));
    }
    if (!floats_hold)
        scene.rounding = round_frames(wide_frames(files, library), library.doubles, scene.frames);
    take_mesh(scene, std::move(first));
    if (scene.objects.empty())
        group_by_parts(scene);
    return scene;
}

}  // namespace

Scene read_sequence(const std::filesystem::path& folder, const SceneLibrary& library)
{
    std::error_code error;
    if (!exists(symlink_status(folder / "mesh.ply", error)))
        return read_numbered(folder, library);
    FileMesh file = read_mesh_file(folder / "mesh.ply", library);
    Scene scene;
    scene.frames = read_frames(folder / "frames.f32", file.mesh.points.size());
    take_mesh(scene, std::move(file));
    add_sequence_facts(scene, folder / "meta.json");
    return scene;
}

}  // namespace bvhbench
