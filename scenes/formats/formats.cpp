// SPDX-License-Identifier: MIT
#include "scenes/formats/formats.h"

#include "geometry/error.h"
#include "scenes/formats/line_reader.h"

namespace bvhbench {

void FileMesh::add_point(const FileNumber& x, const FileNumber& y, const FileNumber& z)
{
    mesh.points.push_back({x.rounded, y.rounded, z.rounded});
    if (has_doubles)
        wide.push_back({x.wide, y.wide, z.wide});
    floats_hold = floats_hold && x.floats_hold && y.floats_hold && z.floats_hold;
}

void FileMesh::add_polygon(const std::vector<uint>& corners)
{
    if (corners.size() > 3)
        polygons.push_back(
            {static_cast<uint>(mesh.faces.size()), static_cast<uint>(corners.size() - 2)});
    for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.faces.push_back({corners[0], corners[k - 1], corners[k]});
}

void FileMesh::add_object(std::string_view name, std::size_t first)
{
    if (mesh.faces.size() > first)
        objects.push_back({std::string(name.empty() ? "unnamed" : name), static_cast<uint>(first),
                           static_cast<uint>(mesh.faces.size() - first)});
}

void list_ignored(const std::map<std::string, std::size_t>& counts, const std::string& of,
                  Reading& reading)
{
    for (const auto& [word, count] : counts)
        reading.ignored.push_back(std::to_string(count) + ' ' + of + (count == 1 ? " " : "s ") +
                                  in_quotes(word));
}

std::string_view without_mark(std::string_view bytes, const std::string& name)
{
    if (bytes.starts_with("\xfe\xff") || bytes.starts_with("\xff\xfe"))
        throw Unavailable(name + " is UTF-16 text, and text is read as ASCII or UTF-8 only");
    if (bytes.starts_with("\xef\xbb\xbf"))
        bytes.remove_prefix(3);
    return bytes;
}

void LineReader::refuse(const std::string& what) const
{
    throw Unavailable(name_ + ", line " + std::to_string(lines_.number()) + ": " + what);
}

std::array<FileNumber, 3> LineReader::point(std::string_view words, const char* otherwise) const
{
    std::array<FileNumber, 3> numbers;
    std::string_view rest = words;
    for (FileNumber& number : numbers) {
        const auto parsed = parse_number(next_word(rest));
        if (!parsed)
            refuse(otherwise + in_quotes(words));
        number = *parsed;
    }
    return numbers;
}

void LineReader::add_vertex(std::string_view words)
{
    const auto [x, y, z] = point(words, "a vertex takes three numbers, and there is ");
    std::string_view rest = words;
    for (int k = 0; k < 3; ++k)
        next_word(rest);
    for (auto word = next_word(rest); !word.empty(); word = next_word(rest))  // colours, normals
        if (!parse_number(word))
            refuse("a vertex takes numbers, and there is " + in_quotes(words));
    file_.add_point(x, y, z);
}

FileMesh LineReader::result()
{
    if (file_.objects.size() == 1)
        file_.objects.clear();
    return std::move(file_);
}

}  // namespace bvhbench
