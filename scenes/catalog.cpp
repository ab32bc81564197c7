// SPDX-License-Identifier: MIT
#include "scenes/catalog.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "scenes/finish.h"
#include "scenes/formats/text.h"
#include "scenes/generate/bend.h"
#include "scenes/generate/catalog.h"
#include "scenes/generate/outlier.h"
#include "scenes/generate/refine.h"
#include "scenes/manifest.h"
#include "scenes/sequence.h"

namespace bvhbench {
namespace {

Scene load_any(std::string_view text, const SceneLibrary& library);

WorkerLimits limits_of(const SceneLibrary& library)
{
    WorkerLimits limits;
    if (library.memory_limit_bytes != 0)
        limits.memory_bytes = library.memory_limit_bytes;
    // What it reads is in its memory and in this process's.
    limits.memory_bytes = std::min<std::uint64_t>(limits.memory_bytes, host_memory_left() / 2);
    if (library.time_limit_s > 0)
        limits.time_s = library.time_limit_s;
    return limits;
}

/// Throws Unavailable, naming `scene` as the user typed it, if the host has fewer than `bytes` bytes left.
void require_memory(std::string_view scene, std::uint64_t bytes)
{
    require_host_memory("scene " + in_quotes(scene), bytes);
}

/// The N of "torus:N".
uint triangle_count(std::string_view scene, std::string_view number, uint most)
{
    const bool digits = !number.empty() && number.find_first_not_of("0123456789") == number.npos;
    const auto value = digits ? parse_integer(number) : std::nullopt;
    if (!value || *value < 1 || *value > std::int64_t{most})
        throw BadUsage("scene " + in_quotes(scene) + " ends in " + in_quotes(number) +
                       " where a triangle count from 1 to " + std::to_string(most) + " goes");
    return static_cast<uint>(*value);
}

Scene generated(std::string_view text, const Generator& generator, std::string_view number)
{
    const uint count = triangle_count(text, number, generator.most);
    require_memory(text, std::uint64_t{count} * generator.bytes_a_triangle);
    Mesh mesh = generator.make(count);
    Scene scene;
    scene.faces = std::move(mesh.faces);
    scene.frames.push_back(std::move(mesh.points));
    scene.source = "generated";
    return scene;
}

/// "N" or "N:F", what follows "cloth-ball:".
Scene moving(std::string_view text, const MovingGenerator& generator, std::string_view rest)
{
    const std::size_t colon = rest.find(':');
    const uint count = triangle_count(text, rest.substr(0, colon), generator.most);
    if (count < generator.least)
        throw BadUsage("scene " + in_quotes(text) + " has too few triangles: there must be " +
                       std::to_string(generator.least) + " at least, one for each object");
    std::int64_t frames = generator.usual_frames;
    if (colon != rest.npos) {
        const std::string_view number = rest.substr(colon + 1);
        const bool digits = !number.empty() && number.find_first_not_of("0123456789") == rest.npos;
        frames = digits ? parse_integer(number).value_or(0) : 0;
        if (frames < 1 || frames > generator.most_frames)
            throw BadUsage("scene " + in_quotes(text) + " ends in " + in_quotes(number) +
                           " where a number of frames from 1 to " +
                           std::to_string(generator.most_frames) + " goes");
    }
    const std::uint64_t bytes_each =
        generator.bytes_a_triangle + generator.bytes_a_frame * static_cast<std::uint64_t>(frames);
    require_memory(text, count * bytes_each);
    Scene scene = generator.make(count, static_cast<uint>(frames));
    scene.has_meshes = true;
    return scene;
}

/// "SCENE:N", what follows "refine:".
Scene refinement(std::string_view text, std::string_view rest, const SceneLibrary& library)
{
    const std::size_t colon = rest.rfind(':');
    if (colon == rest.npos || colon == 0)
        throw BadUsage("scene " + in_quotes(text) + " is not of the form refine:SCENE:N");
    constexpr uint most = 0xffffffffu / 3;  // three half-edges a triangle
    const uint count = triangle_count(text, rest.substr(colon + 1), most);
    require_memory(text, std::uint64_t{count} * 90);
    return refined(load_any(rest.substr(0, colon), library), count);
}

/// "SCENE:K:D", what follows "outlier:".
Scene outlier(std::string_view text, std::string_view rest, const SceneLibrary& library)
{
    const std::size_t last = std::min(rest.rfind(':'), rest.size());
    const std::size_t colon = std::min(rest.substr(0, last).rfind(':'), last);
    const std::string_view number =
        rest.substr(std::min(colon + 1, last), last - std::min(colon + 1, last));
    const std::int64_t triangle = parse_integer(number).value_or(-1);
    const float diameters =
        parse_float(rest.substr(std::min(last + 1, rest.size()))).value_or(INFINITY);
    if (colon == 0 || triangle < 0 || triangle > 0xffffffffll || !(std::fabs(diameters) <= 1e6f))
        throw BadUsage("scene " + in_quotes(text) +
                       " is not of the form outlier:SCENE:K:D, K a triangle and D a distance in "
                       "diagonals of the scene's box");
    return with_outlier(load_any(rest.substr(0, colon), library), static_cast<uint>(triangle),
                        diameters);
}

/// Within the data folder, the path from there: where the folder lies says nothing to who reads it elsewhere.
std::string path_in_library(const std::filesystem::path& path, const SceneLibrary& library)
{
    const std::filesystem::path inside = path.lexically_relative(library.data);
    return library.data.empty() || inside.empty() || *inside.begin() == ".." ? path.string()
                                                                             : inside.string();
}

Scene from_path(const std::filesystem::path& path, const SceneLibrary& library)
{
    Scene scene;
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        scene = read_sequence(path, limits_of(library), library.doubles);
        scene.folder = path;
    } else {
        FileMesh file = read_mesh_file(path, limits_of(library));
        scene.frames.push_back(std::move(file.mesh.points));
        if (!file.floats_hold)
            scene.rounding = round_frames({&file.wide, 1}, library.doubles, scene.frames);
        take_mesh(scene, std::move(file));
    }
    scene.source = path_in_library(path, library);
    return scene;
}

void expect(const ManifestEntry& entry, const Scene& scene, const char* what, std::size_t expected,
            std::size_t found)
{
    if (expected != 0 && found != expected)
        throw OtherCounts("data set '" + entry.set.name + "' has " + std::to_string(expected) +
                          " " + what + ", and " + scene.source + " has " + std::to_string(found));
}

Scene from_data_set(const ManifestEntry& entry, const SceneLibrary& library)
{
    const std::filesystem::path path = located(entry, library.data);
    if (path.empty())
        throw Unavailable("data set '" + entry.set.name + "' is not in the data folder " +
                          in_quotes(library.data.string()) + ": " + entry.source);
    Scene scene = from_path(path, library);
    expect(entry, scene, "triangles", entry.set.triangles, scene.faces.size());
    expect(entry, scene, "vertices", entry.vertices, scene.frames.front().size());
    expect(entry, scene, "frames", entry.frames, scene.frames.size());
    if (!scene.objects.empty())
        expect(entry, scene, "objects", entry.objects, scene.objects.size());
    return scene;
}

[[noreturn]] void unknown(std::string_view text)
{
    std::string known;
    for (const Generator& generator : generators())
        known += std::string(generator.name) + ":N, ";
    for (const MovingGenerator& generator : moving_generators())
        known += std::string(generator.name) + ":N:F, ";
    known += "refine:SCENE:N, outlier:SCENE:K:D, bend:SCENE, ";
    for (const ManifestEntry& entry : manifest())
        known += entry.set.name + ", ";
    throw BadUsage("no scene is called " + in_quotes(text) + "; there are: " + known +
                   "or a path to a mesh file");
}

std::string_view before_last_colon(std::string_view words)
{
    return words.substr(0, std::min(words.rfind(':'), words.size()));
}

bool looks_like_path(std::string_view text)
{
    std::error_code error;
    return text.find('/') != text.npos || std::filesystem::exists(text, error) ||
           is_mesh_file(text);
}

template <class G>
const G* called(std::string_view name, std::span<const G> among)
{
    for (const G& generator : among)
        if (generator.name == name)
            return &generator;
    return nullptr;
}

/// Of other triangles or frames than the folder that it comes from, if it does.
Scene made_of_another(Scene scene)
{
    scene.folder.clear();
    return scene;
}

Scene unfinished(std::string_view text, const SceneLibrary& library)
{
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string_view head = text.substr(0, colon);
    const std::string_view rest = text.substr(std::min(colon + 1, text.size()));
    if (head == "refine")
        return made_of_another(refinement(text, rest, library));
    if (head == "outlier")
        return made_of_another(outlier(text, rest, library));
    if (head == "bend")
        return made_of_another(with_bend(load_any(rest, library)));
    if (const ManifestEntry* const entry = manifest_entry(text))
        return from_data_set(*entry, library);
    if (const Generator* const generator = called(head, generators()))
        return generated(text, *generator, rest);
    if (const MovingGenerator* const generator = called(head, moving_generators()))
        return moving(text, *generator, rest);
    if (looks_like_path(text))
        return from_path(text, library);
    unknown(text);
}

Scene load_any(std::string_view text, const SceneLibrary& library)
{
    Scene scene = unfinished(text, library);
    scene.name = text;
    return finished(std::move(scene));
}

}  // namespace

std::vector<std::string> scene_files(std::string_view text, const SceneLibrary& library)
{
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string_view head = text.substr(0, colon);
    const std::string_view rest = text.substr(std::min(colon + 1, text.size()));
    if (head == "refine")
        return scene_files(before_last_colon(rest), library);
    if (head == "outlier")
        return scene_files(before_last_colon(before_last_colon(rest)), library);
    if (head == "bend")
        return scene_files(rest, library);
    if (const ManifestEntry* const entry = manifest_entry(text))
        return {located(*entry, library.data).string()};
    if (is_sized_generator(head))
        return {};
    return {std::string(text)};
}

std::size_t triangles_said(std::string_view text)
{
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string_view head = text.substr(0, colon);
    const std::string_view rest = text.substr(std::min(colon + 1, text.size()));
    if (head == "refine") {
        const std::string_view inner = before_last_colon(rest);
        triangles_said(inner);
        return triangle_count(text, rest.substr(std::min(inner.size() + 1, rest.size())),
                              0xffffffffu / 3);
    }
    if (head == "outlier")
        return triangles_said(before_last_colon(before_last_colon(rest)));
    if (head == "bend")
        return triangles_said(rest);
    if (const ManifestEntry* const entry = manifest_entry(text))
        return entry->set.triangles;
    if (const Generator* const generator = called(head, generators()))
        return triangle_count(text, rest, generator->most);
    if (const MovingGenerator* const generator = called(head, moving_generators()))
        return triangle_count(text, rest.substr(0, rest.find(':')), generator->most);
    if (!looks_like_path(text))
        unknown(text);
    return 0;
}

bool is_sized_generator(std::string_view text)
{
    return called(text, generators()) != nullptr || called(text, moving_generators()) != nullptr;
}

Scene load_scene(std::string_view text, const SceneLibrary& library)
{
    try {
        Scene scene = load_any(text, library);
        if (scene.rounding.how && library.tell)
            library.tell("scene " + in_quotes(text) + ": " + rounding_text(scene.rounding));
        return scene;
    } catch (const std::bad_alloc&) {
        throw Unavailable("there is not enough memory for scene " + in_quotes(text));
    }
}

}  // namespace bvhbench
