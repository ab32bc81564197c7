// SPDX-License-Identifier: MIT
#include "geometry/error.h"
#include "scenes/formats/line_reader.h"

namespace bvhbench {
namespace {

class ObjReader : LineReader {
public:
    using LineReader::LineReader;

    FileMesh read()
    {
        while (const auto line = lines_.next())
            statement(*line);
        end_object();
        return result();
    }

private:
    void statement(std::string_view line)
    {
        std::string joined;
        while (!line.empty() && line.back() == '\\') {  // continued on the next line
            joined.assign(line.substr(0, line.size() - 1)).push_back(' ');
            const auto more = lines_.next();
            line = joined += more.value_or("");
        }
        const std::string_view keyword = next_word(line);
        if (keyword == "v") {
            add_vertex(line);
        } else if (keyword == "f") {
            face(line);
        } else if (keyword == "o") {
            end_object();
            object_name_ = next_word(line);
        }
        // Lines, points, texture coordinates, normals, groups and materials are ignored.
    }

    void face(std::string_view words)
    {
        corners_.clear();
        for (auto word = next_word(words); !word.empty() && word[0] != '#'; word = next_word(words))
            corners_.push_back(corner(word));
        if (corners_.size() < 3)
            refuse("a face takes three corners, and there are " + std::to_string(corners_.size()));
        file_.add_polygon(corners_);
    }

    /// Parses "7", "7/1", "7//1" or "7/1/1". Negative numbers count back from the last vertex so far.
    uint corner(std::string_view word) const
    {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const auto index = parse_integer(word.substr(0, slash));
        if (!index || word.find_first_not_of("0123456789/-", slash) != word.npos)
            refuse("a corner of a face is no number: " + in_quotes(word));
        const auto seen = static_cast<std::int64_t>(file_.mesh.points.size());
        const std::int64_t absolute = *index < 0 ? seen + *index : *index - 1;
        if (*index == 0 || absolute < 0 || absolute > 0xfffffffe)
            refuse("a face names vertex " + std::to_string(*index) + ", and there are " +
                   std::to_string(seen) + " so far");
        return static_cast<uint>(absolute);
    }

    void end_object()
    {
        file_.add_object(object_name_, first_face_);
        first_face_ = file_.mesh.faces.size();
    }

    std::string object_name_;
};

}  // namespace

FileMesh read_obj(std::string_view bytes, const std::string& name)
{
    if (bytes.starts_with("\xfe\xff") || bytes.starts_with("\xff\xfe"))  // byte order marks
        throw Unavailable(name + " is UTF-16 text, and OBJ is read as ASCII or UTF-8 only");
    if (bytes.starts_with("\xef\xbb\xbf"))
        bytes.remove_prefix(3);
    return ObjReader(bytes, name).read();
}

}  // namespace bvhbench
