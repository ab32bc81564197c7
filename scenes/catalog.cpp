// SPDX-License-Identifier: MIT
#include "scenes/catalog.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "geometry/error.h"
#include "geometry/names.h"
#include "scenes/counts.h"
#include "scenes/facts.h"
#include "scenes/formats/ply_parts.h"
#include "scenes/formats/text.h"
#include "scenes/generate/derived.h"
#include "scenes/generate/generators.h"
#include "scenes/generated.h"
#include "scenes/manifest.h"
#include "scenes/sequence.h"

namespace bvhbench {
namespace {

Scene load_any(std::string_view text, const SceneLibrary& library);

/// A way to derive a scene from another one, such as "refine:SCENE:N".
struct Derivation {
    std::string_view name, form, summary;
    std::size_t words;  ///< number of words after SCENE
};

constexpr Derivation derivations[] = {
    {"refine", "refine:SCENE:N", "any scene with its longest edges cut until it has N triangles",
     1},
    {"outlier", "outlier:SCENE:K:D",
     "any scene with triangle K moved away by D diagonals of its box", 2},
    {"bend", "bend:SCENE", "any scene of one frame with a second one, in which it is bent", 0},
};
/// Triangles of a file by which its pairs are estimated, in a small part of the time that it takes to read it.
constexpr std::size_t sampled_triangles = 64;
constexpr uint most_refined = 0xffffffffu / 3;  // three half-edges per triangle

/// A name like "refine:SCENE:N", split into its parts.
struct Derived {
    const Derivation* how = nullptr;
    std::string_view base;      ///< SCENE
    std::string_view words[2];  ///< the words after SCENE; empty if missing
};

std::optional<Derived> taken_apart(std::string_view text)
{
    const NameParts parts(text);
    const auto how = std::ranges::find(derivations, parts.head, &Derivation::name);
    if (how == std::end(derivations))
        return std::nullopt;
    Derived derived{how, parts.rest, {}};
    for (std::size_t k = how->words; k-- > 0;) {
        const std::size_t colon = std::min(derived.base.rfind(':'), derived.base.size());
        derived.words[k] = derived.base.substr(std::min(colon + 1, derived.base.size()));
        derived.base = derived.base.substr(0, colon);
    }
    return derived;
}

Scene made_of_another(std::string_view text, const Derived& derived, const SceneLibrary& library)
{
    const auto& [how, base, words] = derived;
    if (how->name == "refine") {
        if (base.empty() || base.end() == text.end())
            throw BadUsage("scene " + in_quotes(text) + " is not of the form refine:SCENE:N");
        const uint count = triangle_count(text, words[0], most_refined);
        require_memory(text, std::uint64_t{count} * 90);
        return refined(load_any(base, library), count);
    }
    if (how->name == "bend")
        return with_bend(load_any(base, library));
    const std::int64_t triangle = parse_integer(words[0]).value_or(-1);
    const auto diameters = parse_number(words[1]);
    if (base.empty() || triangle < 0 || triangle > 0xffffffffll || !diameters ||
        !(std::fabs(diameters->rounded) <= 1e6f))
        throw BadUsage("scene " + in_quotes(text) +
                       " is not of the form outlier:SCENE:K:D, K a triangle and D a distance in "
                       "diagonals of the scene's box");
    return with_outlier(load_any(base, library), static_cast<uint>(triangle), diameters->rounded);
}

/// Returns `path` relative to the data folder if it is inside: the absolute path means nothing on another machine.
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
        scene = read_sequence(path, library);
        scene.folder = path;
    } else {
        FileMesh file = read_mesh_file(path, library);
        scene.frames.push_back(std::move(file.mesh.points));
        if (!file.floats_hold)
            take_doubles(scene, {std::move(file.wide)}, library.doubles);
        take_mesh(scene, std::move(file));
    }
    scene.source = path_in_library(path, library);
    return scene;
}

void expect(const ManifestEntry& entry, const Scene& scene, const char* what, std::size_t expected,
            std::size_t found)
{
    if (expected != 0 && found != expected)
        throw OtherCounts("data set '" + entry.name + "' has " + std::to_string(expected) + " " +
                          what + ", and " + scene.source + " has " + std::to_string(found));
}

Scene from_data_set(const ManifestEntry& entry, const SceneLibrary& library)
{
    const std::filesystem::path path = located(entry, library.data);
    if (path.empty())
        throw Unavailable("data set '" + entry.name + "' is not there: " +
                          (library.data.empty() ? "neither --data nor BVHBENCH_DATA names a folder"
                                                : "not in " + in_quotes(library.data.string())) +
                          "; " + entry.source);
    Scene scene = from_path(path, library);
    expect(entry, scene, "triangles", entry.triangles, scene.faces.size());
    expect(entry, scene, "vertices", entry.vertices, scene.frames.front().size());
    expect(entry, scene, "frames", entry.frames, scene.frames.size());
    if (!scene.objects.empty())
        expect(entry, scene, "objects", entry.objects, scene.objects.size());
    return scene;
}

[[noreturn]] void unknown(std::string_view text)
{
    const std::vector<SceneListing> listed = list_scenes({});
    throw BadUsage("no scene is called " + in_quotes(text) +
                   there_are(text, names_of(listed), "or a path to a mesh file"));
}

bool looks_like_path(std::string_view text)
{
    std::error_code error;
    return text.find('/') != text.npos || std::filesystem::exists(text, error) ||
           text.find('.') != text.npos;
}

/// Returns the file of a path of which parts can be read: a mesh, or a folder of frames; nothing if it must be read whole.
std::optional<PlyParts> file_in_parts(const std::filesystem::path& path)
{
    std::error_code error;
    const std::filesystem::path mesh = path / "mesh.ply", frames = path / "frames.f32";
    if (is_regular_file(mesh, error) && is_regular_file(frames, error))
        return PlyParts::opened(mesh, frames);
    if (path.extension() == ".ply" && is_regular_file(path, error))
        return PlyParts::opened(path);
    return std::nullopt;
}

Scene unfinished(std::string_view text, const SceneLibrary& library)
{
    if (const auto derived = taken_apart(text)) {
        Scene scene = made_of_another(text, *derived, library);
        scene.folder.clear();  // its triangles or frames differ
        return scene;
    }
    if (const ManifestEntry* const entry = manifest_entry(text)) {
        if (entry->kind == ManifestEntry::Kind::queries)
            throw BadUsage(std::string(text) +
                           " is no scene but queries of moving points, which "
                           "`accuracy --axis queries` takes");
        return from_data_set(*entry, library);
    }
    if (std::optional<Scene> scene = generated(text))
        return *std::move(scene);
    if (looks_like_path(text))
        return from_path(text, library);
    unknown(text);
}

Scene load_any(std::string_view text, const SceneLibrary& library)
{
    Scene scene = unfinished(text, library);
    scene.name = scene_name(text);
    scene = finished(std::move(scene));
    return library.weld ? welded(std::move(scene)) : scene;
}

}  // namespace

std::vector<SceneListing> list_scenes(const SceneLibrary& library)
{
    std::vector<SceneListing> lines;
    for (const Generator& generator : generators())
        lines.push_back(
            {std::string(generator.name) + (generator.moves ? ":N:F" : ":N"),
             std::string(generator.summary) +
                 (generator.moves
                      ? "; F frames, " + std::to_string(generator.usual_frames) + " if left out"
                      : "")});
    for (const CrowdGenerator& generator : crowd_generators())
        lines.push_back({std::string(generator.name) + ":" + std::string(generator.letters) + ":F",
                         std::string(generator.summary) + "; F frames, 1 if left out"});
    for (const Derivation& derivation : derivations)
        lines.push_back({std::string(derivation.form), std::string(derivation.summary)});
    for (const ManifestEntry& entry : manifest())
        lines.push_back({entry.name, summary(entry, library.data)});
    return lines;
}

std::vector<std::string> scene_files(std::string_view text, const SceneLibrary& library)
{
    if (const auto derived = taken_apart(text))
        return scene_files(derived->base, library);
    if (const ManifestEntry* const entry = manifest_entry(text))
        return {located(*entry, library.data).string()};
    if (is_generated(text))
        return {};
    return {std::string(text)};
}

std::size_t triangles_in_name(std::string_view text)
{
    if (const auto derived = taken_apart(text)) {
        const std::size_t count = triangles_in_name(derived->base);
        return derived->how->name == "refine"
                   ? triangle_count(text, derived->words[0], most_refined)
                   : count;
    }
    if (const ManifestEntry* const entry = manifest_entry(text))
        return entry->triangles;
    if (const auto count = generated_triangles(text))
        return *count;
    if (!looks_like_path(text))
        unknown(text);
    return 0;
}

std::string scene_name(std::string_view text)
{
    const auto in_digits = [](std::string_view word) {
        const auto count = count_of(word);
        return ':' + (count ? std::to_string(*count) : std::string(word));
    };
    if (const auto derived = taken_apart(text)) {
        std::string name = std::string(derived->how->name) + ':' + scene_name(derived->base);
        for (std::size_t k = 0; k < derived->how->words; ++k)
            name += k == 0 ? in_digits(derived->words[k]) : ':' + std::string(derived->words[k]);
        return name;
    }
    const NameParts parts(text);
    if (manifest_entry(text) != nullptr || !is_generated(text))
        return std::string(text);
    std::string name(parts.head);
    for (std::string_view rest = parts.rest; !rest.empty();) {
        const NameParts next(rest);
        name += in_digits(next.head);
        rest = next.rest;
    }
    return name;
}

std::optional<ScenePart> load_part(std::string_view text, uint part, uint parts)
{
    if (taken_apart(text) || manifest_entry(text) != nullptr)
        return std::nullopt;
    const NameParts words(text);
    ScenePart made;
    const auto cut = [&] {
        const auto begin = [&](uint k) { return static_cast<uint>(made.triangles * k / parts); };
        made.run = {begin(part), begin(part + 1) - begin(part)};
    };
    if (const Generator* const generator = generator_called(words.head)) {
        if (generator->run == nullptr)
            return std::nullopt;
        made.triangles = triangle_count(text, words.rest, generator->most);
        cut();
        require_memory(text, std::uint64_t{generator->bytes_a_triangle} * made.run.count);
        made.mesh = generator->run(static_cast<uint>(made.triangles), made.run);
    } else {
        const std::optional<PlyParts> file = file_in_parts(text);
        if (!file)
            return std::nullopt;
        made.triangles = file->triangles();
        cut();
        made.mesh = file->read(made.run);
    }
    for (Point& point : made.mesh.points)
        point = {point.x + 0.0f, point.y + 0.0f, point.z + 0.0f};  // -0 + 0 is +0
    return made;
}

bool is_sized_generator(std::string_view text) { return generator_called(text) != nullptr; }

Scene load_scene(std::string_view text, const SceneLibrary& library)
{
    try {
        Scene scene = load_any(text, library);
        if (scene.source != "generated" && !taken_apart(text))
            scene.facts = mesh_facts(scene, sampled_triangles);
        const std::string rounded = scene.rounding.how ? rounding_text(scene.rounding) : "";
        const std::string surprising = surprises(scene);
        const char* const between = rounded.empty() || surprising.empty() ? "" : "; ";
        if (library.tell && !(rounded + surprising).empty())
            library.tell("scene '" + std::string(text) + "': " + rounded + between + surprising);
        return scene;
    } catch (const std::bad_alloc&) {
        throw Unavailable("there is not enough memory for scene " + in_quotes(text));
    }
}

}  // namespace bvhbench
