// SPDX-License-Identifier: MIT
#include <cstring>

#include "geometry/error.h"
#include "scenes/formats/line_reader.h"

namespace bvhbench {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

// A binary STL file consists of 80 arbitrary bytes, a facet count, and 50 bytes per facet: a normal, three corners of three
// floats each, and two arbitrary bytes.
constexpr std::size_t binary_header = 84;
constexpr std::size_t binary_facet = 50;

std::uint32_t facet_count(std::string_view bytes)
{
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return count;
}

void add_facet(Mesh& mesh)
{
    const auto last = static_cast<uint>(mesh.points.size() - 1);
    mesh.faces.push_back({last - 2, last - 1, last});
}

FileMesh read_binary(std::string_view bytes)
{
    FileMesh file;
    Mesh& mesh = file.mesh;
    const std::uint32_t facets = facet_count(bytes);
    mesh.faces.reserve(facets);
    mesh.points.reserve(std::size_t{3} * facets);
    for (std::size_t k = 0; k < facets; ++k) {
        Point corners[3];
        std::memcpy(corners, bytes.data() + binary_header + k * binary_facet + 12, sizeof corners);
        mesh.points.insert(mesh.points.end(), std::begin(corners), std::end(corners));
        add_facet(mesh);
    }
    return file;
}

class AsciiStl : LineReader {
public:
    using LineReader::LineReader;

    FileMesh read()
    {
        while (const auto line = lines_.next())
            statement(*line);
        if (in_solid_)
            refuse("the file ends inside a solid");
        return result();
    }

private:
    void statement(std::string_view words)
    {
        const std::string_view keyword = next_word(words);
        const auto is = [keyword](std::string_view lower, std::string_view upper) {
            return keyword == lower || keyword == upper;
        };
        if (is("solid", "SOLID")) {
            in_solid_ = true;
            solid_ = next_word(words);
            first_face_ = file_.mesh.faces.size();
        } else if (is("endsolid", "ENDSOLID")) {
            in_solid_ = false;
            file_.add_object(solid_, first_face_);
            first_face_ = file_.mesh.faces.size();
        } else if (is("facet", "FACET")) {
            facet_.clear();
        } else if (is("vertex", "VERTEX")) {
            vertex(words);
        } else if (is("endfacet", "ENDFACET")) {
            close_facet();
        } else if (!keyword.empty() && !is("outer", "OUTER") && !is("endloop", "ENDLOOP")) {
            refuse("not a word of an ascii STL file: " + in_quotes(keyword));
        }
    }

    void vertex(std::string_view words)
    {
        constexpr const char* what = "a facet takes three vertices of three numbers, and there is ";
        facet_.push_back(point(words, what));
        if (facet_.size() > 3 || !in_solid_)
            refuse(what + in_quotes(words));
    }

    void close_facet()
    {
        if (facet_.size() != 3)
            refuse("a facet takes three vertices, and there are " + std::to_string(facet_.size()));
        for (const auto& [x, y, z] : facet_)
            file_.add_point(x, y, z);
        add_facet(file_.mesh);
        facet_.clear();
    }

    std::vector<std::array<FileNumber, 3>> facet_;
    std::string solid_;
    bool in_solid_ = false;
};

}  // namespace

FileMesh read_stl(std::string_view bytes, const std::string& name)
{
    // Binary files may begin with "solid" too, so the file size decides.
    const bool has_header = bytes.size() >= binary_header;
    const std::size_t expected =
        has_header ? binary_header + binary_facet * std::size_t{facet_count(bytes)} : 0;
    if (has_header && bytes.size() == expected)
        return read_binary(bytes);
    std::string_view words = bytes.substr(0, 1000);
    const std::string_view first = next_word(words);
    if (first == "solid" || first == "SOLID")
        return AsciiStl(bytes, name).read();
    if (!has_header)
        throw Unavailable(name + " is neither an ascii nor a binary STL file");
    throw Unavailable(name + " says " + std::to_string(facet_count(bytes)) +
                      " facets, which take " + std::to_string(expected) + " bytes, and has " +
                      std::to_string(bytes.size()));
}

}  // namespace bvhbench
