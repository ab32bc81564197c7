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

/// Returns the numbered files of one format: that of most of them, and one that is read here before those that assimp reads. If there
/// are others, `passed_over` says so. Hidden files are none.
NumberedFiles numbered_files(const std::filesystem::path& folder, std::string& passed_over)
{
    std::map<std::string, NumberedFiles> formats;  // by extension
    std::error_code error;
    const std::filesystem::directory_iterator entries(folder, error);
    if (error)
        throw Unavailable(folder.string() + " cannot be read: " + error.message());
    for (const auto& entry : entries) {
        // Any other file that is named like a frame counts as one; reading it gives the reason why it is not valid.
        if (!is_mesh_file(entry.path()) || entry.is_directory(error) ||
            entry.path().filename().string().starts_with('.'))
            continue;
        const auto number = frame_number(entry.path());
        if (!number)
            continue;
        NumberedFiles& files = formats[lower_case(entry.path().extension().string())];
        if (!files.emplace(*number, entry.path()).second)
            throw Unavailable(folder.string() + " has two files for frame " +
                              std::to_string(*number));
    }
    if (formats.empty())
        return {};
    const auto rank = [](const auto& format) {
        return std::pair(is_read_here(format.first), format.second.size());
    };
    const auto most = std::ranges::max_element(formats, {}, rank);
    for (const auto& [extension, files] : formats) {
        if (extension == most->first)
            continue;
        if (rank(std::pair(extension, files)) == rank(*most))
            throw Unavailable(folder.string() + " has as many frames in " + most->first +
                              " as in " + extension + ": keep one format");
        passed_over +=
            (passed_over.empty() ? "" : ", ") + std::to_string(files.size()) + " in " + extension;
    }
    if (!passed_over.empty())
        passed_over = "its frames are the " + std::to_string(most->second.size()) + " files in " +
                      most->first + ", and " + passed_over + " are passed over";
    return most->second;
}

bool same(const std::vector<Face>& a, const std::vector<Face>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Face)) == 0;
}

/// Returns the vertices of each frame in doubles, read again. Few sequences need this, so the others use no memory for it.
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

/// Makes every frame but the first a scene of its own, with its triangles in `meshes`.
void part_frames(Scene& scene, std::vector<FileMesh>& meshes)
{
    for (std::size_t k = 1; k < meshes.size(); ++k) {
        Scene& later = scene.later.emplace_back();
        later.frames.push_back(std::move(scene.frames[k]));
        later.rounding = scene.rounding;
        take_mesh(later, std::move(meshes[k]));
        if (later.objects.empty())
            group_by_parts(later);
    }
    scene.frames.resize(1);
}

Scene read_numbered(const std::filesystem::path& folder, const SceneLibrary& library)
{
    std::string passed_over;
    const NumberedFiles files = numbered_files(folder, passed_over);
    if (files.empty())
        throw Unavailable(folder.string() +
                          " has neither mesh.ply and frames.f32 nor numbered mesh files");
    Scene scene;
    std::vector<FileMesh> meshes;  // the first; with `any_topology`, all
    bool floats_hold = true, share_triangles = true;
    for (const auto& [number, path] : files) {
        FileMesh file = read_mesh_file(path, library);
        floats_hold = floats_hold && file.floats_hold;
        const bool differs =
            !meshes.empty() && (!same(meshes[0].mesh.faces, file.mesh.faces) ||
                                file.mesh.points.size() != scene.frames.front().size());
        if (differs && !library.any_topology)
            throw Unavailable(path.string() + " has other triangles than " +
                              files.begin()->second.string() +
                              ", which only frames of `collide` may have, whose trees are rebuilt: "
                              "without refits, fronts, --swept, --features and --between");
        share_triangles = share_triangles && !differs;
        scene.frames.push_back(std::move(file.mesh.points));
        file.wide.clear();
        if (meshes.empty() || library.any_topology)
            meshes.push_back(std::move(file));
        scene.frame_labels.push_back(std::to_string(number));
    }
    if (!floats_hold)
        take_doubles(scene, wide_frames(files, library), library.doubles);
    if (!share_triangles)
        part_frames(scene, meshes);
    take_mesh(scene, std::move(meshes[0]));
    if (scene.objects.empty())
        group_by_parts(scene);
    if (!passed_over.empty())
        scene.reading.surprises.push_back(passed_over);
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
