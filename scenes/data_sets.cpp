// SPDX-License-Identifier: MIT
#include "geometry/error.h"
#include "scenes/generate/catalog.h"
#include "scenes/manifest.h"

namespace bvhbench {
namespace {

/// Whether the data set NAME or the one that "refine:NAME:N" is made from is there; what is generated always is.
bool is_possible(const std::string& scene, const SceneLibrary& library)
{
    if (const ManifestEntry* const entry = manifest_entry(scene))
        return !located(*entry, library.data).empty();
    const std::size_t first = scene.find(':');
    const std::size_t last = scene.rfind(':');
    if (scene.compare(0, first, "refine") != 0 || last <= first)
        return true;
    const ManifestEntry* const base = manifest_entry(scene.substr(first + 1, last - first - 1));
    return base != nullptr && !located(*base, library.data).empty();
}

std::string summary(const ManifestEntry& entry, const SceneLibrary& library)
{
    const std::filesystem::path path = located(entry, library.data);
    std::string text = entry.note;
    if (entry.set.triangles != 0)
        text += "; " + std::to_string(entry.set.triangles) + " triangles";
    if (entry.frames > 1)
        text += ", " + std::to_string(entry.frames) + " frames";
    return text + (path.empty() ? "; not found: " + entry.source : "; found: " + path.string());
}

}  // namespace

std::vector<SceneListing> list_scenes(const SceneLibrary& library)
{
    std::vector<SceneListing> lines;
    for (const Generator& generator : generators())
        lines.push_back({std::string(generator.name) + ":N", std::string(generator.summary)});
    for (const MovingGenerator& generator : moving_generators())
        lines.push_back({std::string(generator.name) + ":N:F",
                         std::string(generator.summary) + "; F frames, " +
                             std::to_string(generator.usual_frames) + " if left out"});
    lines.push_back(
        {"refine:SCENE:N", "any scene with its longest edges cut until it has N triangles"});
    lines.push_back(
        {"outlier:SCENE:K:D", "any scene with triangle K moved away by D diagonals of its box"});
    lines.push_back(
        {"bend:SCENE", "any scene of one frame with a second one, in which it is bent"});
    for (const ManifestEntry& entry : manifest())
        lines.push_back({entry.set.name, summary(entry, library)});
    return lines;
}

const DataSet* find_data_set(std::string_view name)
{
    const ManifestEntry* const entry = manifest_entry(name);
    return entry == nullptr ? nullptr : &entry->set;
}

Scene load_or_stand_in(const DataSet& set, const SceneLibrary& library)
{
    const ManifestEntry* const entry = manifest_entry(set.name);
    if (entry == nullptr)
        throw BadUsage("no data set is called '" + set.name + "'");
    // A file of another size is another edition of the model: not this data set, and no error.
    if (!located(*entry, library.data).empty()) {
        try {
            return load_scene(set.name, library);
        } catch (const OtherCounts&) {
            if (entry->stand_ins.empty())
                throw;
        }
    }
    for (const std::string& stand_in : entry->stand_ins)
        if (is_possible(stand_in, library)) {
            Scene scene = load_scene(stand_in, library);
            scene.stand_in_for = set.name;
            return scene;
        }
    return load_scene(set.name, library);  // says what is missing
}

}  // namespace bvhbench
