// SPDX-License-Identifier: MIT
#include "scenes/manifest.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "geometry/names.h"
#include "scenes/catalog.h"
#include "scenes/embedded.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

constexpr std::string_view columns =
    "name\tkind\ttriangles\tvertices\tobjects\tframes\tfiles\tsha256\turl\tstand_ins\tlicence\t"
    "source\tnote";

std::vector<std::string> split(std::string_view text, char separator)
{
    std::vector<std::string> parts;
    while (true) {
        const std::size_t end = text.find(separator);
        parts.emplace_back(text.substr(0, end));
        if (end == text.npos)
            return parts;
        text.remove_prefix(end + 1);
    }
}

std::vector<std::string> list(const std::string& field)
{
    return field == "-" ? std::vector<std::string>{} : split(field, ' ');
}

std::size_t count(const std::string& field)
{
    if (field == "-")
        return 0;
    const auto value = parse_integer(field);
    if (!value || *value < 1)
        throw std::logic_error("scenes/manifest.tsv has a count of " + in_quotes(field));
    return static_cast<std::size_t>(*value);
}

ManifestEntry parse_entry(std::string_view line)
{
    const std::vector<std::string> field = split(line, '\t');
    constexpr std::array<std::string_view, 3> kinds = {"mesh", "frames", "queries"};
    const auto kind = field.size() == 13 ? std::ranges::find(kinds, field[1]) : kinds.end();
    if (kind == kinds.end())
        throw std::logic_error("scenes/manifest.tsv has a line like " + in_quotes(line));
    ManifestEntry entry;
    entry.name = field[0];
    entry.triangles = count(field[2]);
    entry.stand_ins = list(field[9]);
    entry.kind = static_cast<ManifestEntry::Kind>(kind - kinds.begin());
    entry.vertices = count(field[3]);
    entry.objects = count(field[4]);
    entry.frames = count(field[5]);
    entry.files = list(field[6]);
    entry.source = field[11];
    entry.note = field[12];
    return entry;
}

}  // namespace

std::vector<ManifestEntry> parse_manifest(std::string_view text)
{
    std::vector<ManifestEntry> entries;
    bool has_columns = false;
    Lines lines(text);
    while (const auto line = lines.next()) {
        if (line->empty() || line->front() == '#')
            continue;
        if (!has_columns && *line != columns)
            throw std::logic_error("scenes/manifest.tsv has other columns than are read");
        if (has_columns)
            entries.push_back(parse_entry(*line));
        has_columns = true;
    }
    return entries;
}

std::span<const ManifestEntry> manifest()
{
    static const std::vector<ManifestEntry> entries =
        parse_manifest(embedded_scene_text("scenes/manifest.tsv").value());
    return entries;
}

const ManifestEntry* manifest_entry(std::string_view name) { return find_name(manifest(), name); }

std::filesystem::path located(const ManifestEntry& entry, const std::filesystem::path& data)
{
    if (data.empty())
        return {};
    std::error_code error;
    for (const std::filesystem::path file : entry.files)
        for (const auto& path : {data / file, data / file.filename()})
            if (entry.kind == ManifestEntry::Kind::mesh
                    ? std::filesystem::is_regular_file(path, error)
                    : std::filesystem::is_directory(path, error))
                return path;
    return {};
}

std::string summary(const ManifestEntry& entry, const std::filesystem::path& data)
{
    const std::filesystem::path path = located(entry, data);
    std::string text = entry.note;
    if (entry.triangles != 0)
        text += "; " + std::to_string(entry.triangles) + " triangles";
    if (entry.frames > 1)
        text += ", " + std::to_string(entry.frames) + " frames";
    return text + (path.empty() ? "; not found: " + entry.source : "; found: " + path.string());
}

Scene load_or_stand_in(std::string_view text, const SceneLibrary& library)
{
    const ManifestEntry* const entry = manifest_entry(text);
    if (entry == nullptr)
        return load_scene(text, library);
    // True if the scene can be made: it is generated, or the files that it is made from exist.
    const auto is_possible = [&](const std::string& scene) {
        return !std::ranges::count(scene_files(scene, library), "");
    };
    // A file of another size is another edition of the model: it is not this data set, and this is not an error.
    if (!located(*entry, library.data).empty()) {
        try {
            return load_scene(text, library);
        } catch (const OtherCounts&) {
            if (entry->stand_ins.empty())
                throw;
        }
    }
    for (const std::string& stand_in : entry->stand_ins)
        if (is_possible(stand_in)) {
            Scene scene = load_scene(stand_in, library);
            scene.stand_in_for = text;
            return scene;
        }
    return load_scene(text, library);  // throws, naming what is missing
}

}  // namespace bvhbench
