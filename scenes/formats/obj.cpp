// SPDX-License-Identifier: MIT
#include "geometry/error.h"
#include "scenes/formats/formats.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

class ObjReader {
public:
    ObjReader(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

    FileMesh read()
    {
        while (const auto line = lines_.next())
            statement(*line);
        close_object();
        if (file_.objects.size() == 1)
            file_.objects.clear();  // one object, named or not, is all faces
        return std::move(file_);
    }

private:
    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Unavailable(name_ + ", line " + std::to_string(lines_.number()) + ": " + what);
    }

    void statement(std::string_view line)
    {
        std::string joined;
        while (!line.empty() && line.back() == '\\') {  // continued on the next line
            joined.assign(line.substr(0, line.size() - 1)).push_back(' ');
            const auto more = lines_.next();
            line = joined += more.value_or("");
        }
        Words words(line);
        const std::string_view keyword = words.next();
        if (keyword == "v")
            vertex(words);
        else if (keyword == "f")
            face(words);
        else if (keyword == "o")
            open_object(words);
        // Lines, points, texture coordinates, normals, groups and materials are not triangles.
    }

    void vertex(Words words)
    {
        const std::string_view text = words.rest();
        const auto point = parse_point(words);
        if (!point)
            refuse("a vertex takes three numbers, and there is " + in_quotes(text));
        file_.add(*point);
    }

    void face(Words words)
    {
        corners_.clear();
        for (auto word = words.next(); !word.empty() && word[0] != '#'; word = words.next())
            corners_.push_back(corner(word));
        if (corners_.size() < 3)
            refuse("a face takes three corners, and there are " + std::to_string(corners_.size()));
        add_fan(file_.mesh.faces, corners_);
    }

    /// "7", "7/1", "7//1" or "7/1/1"; negative counts back from the last vertex so far.
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

    void open_object(Words words)
    {
        close_object();
        object_name_ = words.next();
    }

    void close_object()
    {
        const auto faces = static_cast<uint>(file_.mesh.faces.size());
        if (faces > first_face_)
            file_.objects.push_back({object_name_.empty() ? "unnamed" : object_name_, first_face_,
                                     faces - first_face_});
        first_face_ = faces;
    }

    Lines lines_;
    const std::string& name_;
    FileMesh file_;
    std::vector<uint> corners_;
    std::string object_name_;
    uint first_face_ = 0;
};

}  // namespace

FileMesh read_obj(std::string_view bytes, const std::string& name)
{
    if (is_utf16(bytes))
        throw Unavailable(name + " is UTF-16 text, and OBJ is read as ASCII or UTF-8 only");
    if (bytes.substr(0, 3) == "\xef\xbb\xbf")
        bytes.remove_prefix(3);
    return ObjReader(bytes, name).read();
}

}  // namespace bvhbench
