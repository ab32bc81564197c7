// SPDX-License-Identifier: MIT
#include <cstring>

#include "geometry/error.h"
#include "scenes/formats/formats.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

// A binary STL file: 80 bytes of anything, a facet count, and 50 bytes a facet: a normal, three corners
// of three floats, two bytes of anything.
constexpr std::size_t binary_header = 84;
constexpr std::size_t binary_facet = 50;

std::uint32_t facet_count(std::string_view bytes)
{
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return count;
}

FileMesh read_binary(std::string_view bytes)
{
    FileMesh file;
    const std::uint32_t facets = facet_count(bytes);
    file.mesh.faces.reserve(facets);
    file.mesh.points.reserve(std::size_t{3} * facets);
    for (std::size_t k = 0; k < facets; ++k) {
        Point corners[3];
        std::memcpy(corners, bytes.data() + binary_header + k * binary_facet + 12, sizeof corners);
        const auto first = static_cast<uint>(file.mesh.points.size());
        file.mesh.points.insert(file.mesh.points.end(), std::begin(corners), std::end(corners));
        file.mesh.faces.push_back({first, first + 1, first + 2});
    }
    return file;
}

class AsciiStl {
public:
    AsciiStl(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

    FileMesh read()
    {
        while (const auto line = lines_.next())
            statement(Words(*line));
        if (in_solid_)
            refuse("the file ends inside a solid");
        if (file_.objects.size() == 1)
            file_.objects.clear();
        return std::move(file_);
    }

private:
    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Unavailable(name_ + ", line " + std::to_string(lines_.number()) + ": " + what);
    }

    void statement(Words words)
    {
        const std::string_view word = words.next();
        if (word == "solid" || word == "SOLID")
            open_solid(words);
        else if (word == "endsolid" || word == "ENDSOLID")
            close_solid();
        else if (word == "facet" || word == "FACET")
            corners_.clear();
        else if (word == "vertex" || word == "VERTEX")
            corner(words);
        else if (word == "endfacet" || word == "ENDFACET")
            close_facet();
        else if (!word.empty() && word != "outer" && word != "OUTER" && word != "endloop" &&
                 word != "ENDLOOP")
            refuse("not a word of an ascii STL file: " + in_quotes(word));
    }

    void open_solid(Words words)
    {
        in_solid_ = true;
        const std::string_view title = words.next();
        solid_ = title.empty() ? "unnamed" : title;
        first_face_ = static_cast<uint>(file_.mesh.faces.size());
    }

    void close_solid()
    {
        in_solid_ = false;
        const auto faces = static_cast<uint>(file_.mesh.faces.size());
        if (faces > first_face_)
            file_.objects.push_back({solid_, first_face_, faces - first_face_});
        first_face_ = faces;
    }

    void corner(Words words)
    {
        const std::string_view text = words.rest();
        const auto point = parse_point(words);
        if (!point || corners_.size() == 3 || !in_solid_)
            refuse("a facet takes three vertices of three numbers, and there is " +
                   in_quotes(text));
        corners_.push_back(*point);
    }

    void close_facet()
    {
        if (corners_.size() != 3)
            refuse("a facet takes three vertices, and there are " +
                   std::to_string(corners_.size()));
        const auto first = static_cast<uint>(file_.mesh.points.size());
        for (const FilePoint& corner : corners_)
            file_.add(corner);
        file_.mesh.faces.push_back({first, first + 1, first + 2});
        corners_.clear();
    }

    Lines lines_;
    const std::string& name_;
    FileMesh file_;
    std::vector<FilePoint> corners_;
    std::string solid_;
    uint first_face_ = 0;
    bool in_solid_ = false;
};

}  // namespace

FileMesh read_stl(std::string_view bytes, const std::string& name)
{
    // Binary files may begin with "solid" too, so the size decides.
    const bool has_header = bytes.size() >= binary_header;
    const std::size_t expected =
        has_header ? binary_header + binary_facet * std::size_t{facet_count(bytes)} : 0;
    if (has_header && bytes.size() == expected)
        return read_binary(bytes);
    const std::string_view first = Words(bytes.substr(0, 1000)).next();
    if (first == "solid" || first == "SOLID")
        return AsciiStl(bytes, name).read();
    if (!has_header)
        throw Unavailable(name + " is neither an ascii nor a binary STL file");
    throw Unavailable(name + " says " + std::to_string(facet_count(bytes)) +
                      " facets, which take " + std::to_string(expected) + " bytes, and has " +
                      std::to_string(bytes.size()));
}

}  // namespace bvhbench
