// SPDX-License-Identifier: MIT
#include "scenes/formats/line_reader.h"

namespace bvhbench {
namespace {

class OffReader : LineReader {
public:
    OffReader(std::string_view bytes, const std::string& name)
        : LineReader(bytes, name), size_(bytes.size())
    {}

    FileMesh read()
    {
        header();
        const std::size_t vertices = count("vertices");
        const std::size_t faces = count("faces");
        file_.mesh.points.reserve(vertices);
        for (std::size_t k = 0; k < vertices; ++k) {
            expect_line("vertex", k, vertices);
            add_vertex(words_);
        }
        for (std::size_t k = 0; k < faces; ++k) {
            expect_line("face", k, faces);
            face();
        }
        if (next_line())
            refuse("there is more than the header says: " + in_quotes(words_));
        return result();
    }

private:
    /// Advances to the next line that holds more than white space and a comment.
    bool next_line()
    {
        while (const auto line = lines_.next()) {
            words_ = line->substr(0, line->find('#'));
            std::string_view rest = words_;
            if (!next_word(rest).empty())
                return true;
        }
        return false;
    }

    void expect_line(const char* of, std::size_t k, std::size_t count)
    {
        if (!next_line())
            refuse(std::string("the file ends at ") + of + ' ' + std::to_string(k) + " of " +
                   std::to_string(count));
    }

    void header()
    {
        std::string_view word = next_line() ? next_word(words_) : "";
        const std::string_view whole = word;
        while (!word.empty() && std::string_view("STCN").find(word[0]) != word.npos)
            word.remove_prefix(1);
        if (!word.starts_with("OFF"))
            refuse("an OFF file begins with OFF, and there is " + in_quotes(whole));
        word.remove_prefix(3);
        if (!word.empty()) {  // "OFF8 12 0", as files of ModelNet begin
            if (word.find_first_not_of("0123456789") != word.npos)
                refuse("an OFF file begins with OFF, and there is " + in_quotes(whole));
            words_ = {word.data(), words_.data() + words_.size()};
        }
        std::string_view rest = words_;
        if (next_word(rest) == "BINARY")
            refuse("binary OFF is not read: export it as text");
    }

    /// Returns the vertex or face count. Each takes at least two bytes, which limits the count by the size of the file.
    std::size_t count(const std::string& what)
    {
        std::string_view word = next_word(words_);
        if (word.empty() && next_line())
            word = next_word(words_);
        const auto value = parse_integer(word);
        if (!value || *value < 0)
            refuse("the number of " + what + " is " + in_quotes(word));
        if (static_cast<std::uint64_t>(*value) > size_ / 2)
            refuse("the header says " + std::to_string(*value) + " " + what +
                   ", and the file has " + std::to_string(size_) + " bytes");
        return static_cast<std::size_t>(*value);
    }

    void face()
    {
        const std::string_view text = words_;
        const auto size = parse_integer(next_word(words_));
        if (!size || *size < 3)
            refuse("a face takes three corners, and there is " + in_quotes(text));
        corners_.clear();
        for (std::int64_t corner = 0; corner < *size; ++corner) {
            const auto index = parse_integer(next_word(words_));
            if (!index)
                refuse("a face of " + std::to_string(*size) + " corners is " + in_quotes(text));
            if (*index < 0 || static_cast<std::uint64_t>(*index) >= file_.mesh.points.size())
                refuse("a face names vertex " + std::to_string(*index) + " of " +
                       std::to_string(file_.mesh.points.size()));
            corners_.push_back(static_cast<uint>(*index));
        }
        for (auto word = next_word(words_); !word.empty(); word = next_word(words_))  // a colour
            if (!parse_number(word))
                refuse("a face takes numbers, and there is " + in_quotes(text));
        file_.add_polygon(corners_);
    }

    std::string_view words_;  ///< unread part of the line
    std::size_t size_;
};

}  // namespace

FileMesh read_off(std::string_view bytes, const std::string& name)
{
    return OffReader(without_mark(bytes, name), name).read();
}

}  // namespace bvhbench
