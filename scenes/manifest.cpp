// SPDX-License-Identifier: MIT
#include "scenes/manifest.h"

#include <stdexcept>

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
    if (field.size() != 13 || (field[1] != "mesh" && field[1] != "frames"))
        throw std::logic_error("scenes/manifest.tsv has a line like " + in_quotes(line));
    ManifestEntry entry;
    entry.stand_ins = list(field[9]);
    entry.set = {field[0], count(field[2]), entry.stand_ins.empty() ? "" : entry.stand_ins.back()};
    entry.is_frames = field[1] == "frames";
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

const ManifestEntry* manifest_entry(std::string_view name)
{
    for (const ManifestEntry& entry : manifest())
        if (entry.set.name == name)
            return &entry;
    return nullptr;
}

std::filesystem::path located(const ManifestEntry& entry, const std::filesystem::path& data)
{
    if (data.empty())
        return {};
    std::error_code error;
    for (const std::filesystem::path file : entry.files)
        for (const auto& path : {data / file, data / file.filename()})
            if (entry.is_frames ? std::filesystem::is_directory(path, error)
                                : std::filesystem::is_regular_file(path, error))
                return path;
    return {};
}

}  // namespace bvhbench
