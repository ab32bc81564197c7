// SPDX-License-Identifier: MIT
#include "geometry/error.h"
#include "scenes/formats/formats.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

class OffReader {
public:
    OffReader(std::string_view bytes, const std::string& name)
        : lines_(bytes), words_(""), size_(bytes.size()), name_(name)
    {}

    FileMesh read()
    {
        header();
        const std::size_t vertices = count("vertices");
        const std::size_t faces = count("faces");
        file_.mesh.points.reserve(vertices);
        for (std::size_t k = 0; k < vertices; ++k)
            vertex(k, vertices);
        for (std::size_t k = 0; k < faces; ++k)
            face(k, faces);
        if (next_line())
            refuse("there is more than the header says: " + in_quotes(words_.rest()));
        return std::move(file_);
    }

private:
    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Unavailable(name_ + ", line " + std::to_string(lines_.number()) + ": " + what);
    }

    /// Moves on to the next line with anything but white space and a comment on it.
    bool next_line()
    {
        while (auto line = lines_.next()) {
            const std::string_view text = line->substr(0, line->find('#'));
            if (Words(text).next().empty())
                continue;
            words_ = Words(text);
            return true;
        }
        return false;
    }

    void header()
    {
        const bool any = next_line();
        const std::string_view word = any ? words_.next() : "";
        const std::size_t end = word.find("OFF");
        const std::string_view prefix = word.substr(0, std::min(end, word.size()));
        if (end == word.npos || end + 3 != word.size() ||
            prefix.find_first_not_of("STCN") != prefix.npos)
            refuse("an OFF file begins with OFF, and there is " + in_quotes(word));
    }

    /// The vertex or face count, which no file can exceed that takes two bytes at least for each.
    std::size_t count(const std::string& what)
    {
        std::string_view word = words_.next();
        if (word.empty() && next_line())
            word = words_.next();
        const auto value = parse_integer(word);
        if (!value || *value < 0)
            refuse("the number of " + what + " is " + in_quotes(word));
        if (static_cast<std::uint64_t>(*value) > size_ / 2)
            refuse("the header says " + std::to_string(*value) + " " + what +
                   ", and the file has " + std::to_string(size_) + " bytes");
        return static_cast<std::size_t>(*value);
    }

    void vertex(std::size_t k, std::size_t vertices)
    {
        if (!next_line())
            refuse("the file ends at vertex " + std::to_string(k) + " of " +
                   std::to_string(vertices));
        const std::string_view text = words_.rest();
        const auto point = parse_point(words_);
        if (!point)
            refuse("a vertex takes three numbers, and there is " + in_quotes(text));
        file_.add(*point);
    }

    void face(std::size_t k, std::size_t faces)
    {
        if (!next_line())
            refuse("the file ends at face " + std::to_string(k) + " of " + std::to_string(faces));
        const std::string_view text = words_.rest();
        const auto size = parse_integer(words_.next());
        if (!size || *size < 3)
            refuse("a face takes three corners, and there is " + in_quotes(text));
        corners_.clear();
        for (std::int64_t corner = 0; corner < *size; ++corner) {
            const auto index = parse_integer(words_.next());
            if (!index)
                refuse("a face of " + std::to_string(*size) + " corners is " + in_quotes(text));
            if (*index < 0 || static_cast<std::uint64_t>(*index) >= file_.mesh.points.size())
                refuse("a face names vertex " + std::to_string(*index) + " of " +
                       std::to_string(file_.mesh.points.size()));
            corners_.push_back(static_cast<uint>(*index));
        }
        add_fan(file_.mesh.faces, corners_);
    }

    Lines lines_;
    Words words_;
    std::size_t size_;
    const std::string& name_;
    FileMesh file_;
    std::vector<uint> corners_;
};

}  // namespace

FileMesh read_off(std::string_view bytes, const std::string& name)
{
    return OffReader(bytes, name).read();
}

}  // namespace bvhbench
