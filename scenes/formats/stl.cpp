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

/// Reads text, in upper or lower case, several statements a line or one. Solids, facets and their corners nest, and each is closed
/// before the next begins. Loops may be left out.
class AsciiStl : LineReader {
public:
    using LineReader::LineReader;

    FileMesh read()
    {
        while (const auto line = lines_.next())
            for (std::string_view words = *line; statement(words);) {
            }
        if (facet_line_ != 0)
            refuse("the file ends inside the facet of line " + std::to_string(facet_line_));
        if (solid_line_ != 0)
            refuse("the file ends inside a solid, of line " + std::to_string(solid_line_));
        return result();
    }

private:
    /// Reads the statement at the front of `words` and removes it. False at the end of the line.
    bool statement(std::string_view& words)
    {
        const std::string keyword = lower_case(next_word(words));
        if (keyword == "solid") {
            expect_closed(facet_line_, "a solid begins", "facet");
            expect_closed(solid_line_, "a solid begins", "solid");
            solid_line_ = lines_.number();
            solid_ = name(words);
            first_face_ = file_.mesh.faces.size();
        } else if (keyword == "endsolid") {
            expect_closed(facet_line_, "a solid ends", "facet");
            expect_open(solid_line_, "endsolid", "solid");
            solid_line_ = 0;
            name(words);
            file_.add_object(solid_, first_face_);
        } else if (keyword == "facet") {
            expect_open(solid_line_, "a facet", "solid");
            expect_closed(facet_line_, "a facet begins", "facet");
            facet_line_ = lines_.number();
            facet_.clear();
            normal(words);
        } else if (keyword == "vertex") {
            expect_open(facet_line_, "a vertex", "facet");
            vertex(words);
        } else if (keyword == "endfacet") {
            expect_open(facet_line_, "endfacet", "facet");
            close_facet();
        } else if (keyword == "outer") {
            next_word(words);  // loop
        } else if (!keyword.empty() && keyword != "endloop") {
            refuse("not a word of an ascii STL file: " + in_quotes(keyword));
        }
        return !keyword.empty();
    }

    /// Removes the rest of a line, a solid's name, and returns its first word. Refuses a rest that holds facets.
    std::string name(std::string_view& words) const
    {
        const std::string first(next_word(words));
        std::string_view rest = words;
        for (std::string word = lower_case(first); !word.empty();
             word = lower_case(next_word(rest)))
            if (word == "facet" || word == "vertex" || word == "endsolid")
                refuse("the name of a solid goes to the end of its line, and there is " +
                       in_quotes(words));
        words = {};
        return first;
    }

    /// Removes "normal" and its numbers, whatever they are; a facet may come without.
    static void normal(std::string_view& words)
    {
        std::string_view rest = words;
        if (lower_case(next_word(rest)) != "normal")
            return;
        for (int k = 0; k < 3; ++k) {
            words = rest;
            if (!parse_number(next_word(rest)))
                return;
        }
        words = rest;
    }

    void expect_closed(std::size_t line, const std::string& what, const std::string& of) const
    {
        if (line != 0)
            refuse(what + ", and the " + of + " of line " + std::to_string(line) + " has no end" +
                   of);
    }

    void expect_open(std::size_t line, const std::string& what, const std::string& of) const
    {
        if (line == 0)
            refuse(what + " stands outside of a " + of);
    }

    void vertex(std::string_view& words)
    {
        constexpr const char* what = "a facet takes three vertices of three numbers, and there is ";
        facet_.push_back(point(words, what));
        for (int k = 0; k < 3; ++k)
            next_word(words);
        if (facet_.size() > 3)
            refuse(what + in_quotes(words));
    }

    void close_facet()
    {
        if (facet_.size() != 3)
            refuse("a facet takes three vertices, and there are " + std::to_string(facet_.size()));
        for (const auto& [x, y, z] : facet_)
            file_.add_point(x, y, z);
        add_facet(file_.mesh);
        facet_line_ = 0;
    }

    std::vector<std::array<FileNumber, 3>> facet_;
    std::string solid_;
    std::size_t solid_line_ = 0, facet_line_ = 0;  ///< where the open one begins; 0: none is open
};

/// True if a file of another size than a binary one is meant to be binary: text has no zero bytes.
bool looks_binary(std::string_view bytes) { return bytes.substr(0, 1000).find('\0') != bytes.npos; }

}  // namespace

FileMesh read_stl(std::string_view bytes, const std::string& name)
{
    // Binary files may begin with "solid" too, so the file size decides.
    const bool has_header = bytes.size() >= binary_header;
    const std::size_t expected =
        has_header ? binary_header + binary_facet * std::size_t{facet_count(bytes)} : 0;
    if (has_header && bytes.size() == expected)
        return read_binary(bytes);
    const std::string_view text = without_mark(bytes, name);
    std::string_view words = text;
    const std::string_view first = next_word(words);
    if (lower_case(first) == "solid" && !looks_binary(bytes))
        return AsciiStl(text, name).read();
    if (!bytes.empty() && !looks_binary(bytes))
        throw Unavailable(name + " is text, and an ascii STL file begins with solid, not with " +
                          in_quotes(first));
    if (!has_header)
        throw Unavailable(name + " is neither an ascii nor a binary STL file");
    throw Unavailable(name + " says " + std::to_string(facet_count(bytes)) +
                      " facets, which take " + std::to_string(expected) + " bytes, and has " +
                      std::to_string(bytes.size()));
}

}  // namespace bvhbench
