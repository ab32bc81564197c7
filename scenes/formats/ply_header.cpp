// SPDX-License-Identifier: MIT
#include "scenes/formats/ply_header.h"

#include <optional>
#include <utility>

#include "geometry/error.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

std::optional<PlyType> type_called(std::string_view word)
{
    static constexpr std::pair<std::string_view, PlyType> names[] = {
        {"char", PlyType::int8},       {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},     {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},     {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},   {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64},
    };
    for (const auto& [name, type] : names)
        if (name == word)
            return type;
    return std::nullopt;
}

class PlyHeaderReader {
public:
    PlyHeaderReader(std::string_view bytes, const std::string& name)
        : bytes_(bytes), rest_(bytes), name_(name)
    {}

    PlyHeader read()
    {
        find_line_end();
        if (Words(line()).next() != "ply")
            refuse("a PLY file begins with ply, and there is " + in_quotes(bytes_.substr(0, 8)));
        while (statement(line())) {
        }
        if (!has_format_)
            refuse("the header names no format");
        header_.size = bytes_.size() - rest_.size();
        return std::move(header_);
    }

private:
    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Unavailable(name_ + ", line " + std::to_string(number_) + ": " + what);
    }

    // The first line shows how lines end. It matters for the last: binary data may begin with a newline.
    void find_line_end()
    {
        const std::size_t end = bytes_.find_first_of("\r\n");
        if (end != bytes_.npos && bytes_[end] == '\r')
            line_end_ = bytes_.substr(end, 2) == "\r\n" ? "\r\n" : "\r";
    }

    std::string_view line()
    {
        ++number_;
        const std::size_t end = rest_.find(line_end_);
        if (end == rest_.npos)
            refuse("the header does not end with end_header");
        const std::string_view text = rest_.substr(0, end);
        rest_.remove_prefix(end + line_end_.size());
        return text;
    }

    /// False at the end of the header.
    bool statement(std::string_view text)
    {
        Words words(text);
        const std::string_view keyword = words.next();
        if (keyword == "format")
            format(words);
        else if (keyword == "element")
            element(words);
        else if (keyword == "property")
            property(words);
        else if (keyword != "comment" && keyword != "obj_info" && keyword != "end_header" &&
                 !keyword.empty())
            refuse("not a word of a PLY header: " + in_quotes(keyword));
        return keyword != "end_header";
    }

    void format(Words words)
    {
        const std::string_view word = words.next();
        if (word == "binary_little_endian")
            header_.format = PlyFormat::little_endian;
        else if (word == "binary_big_endian")
            header_.format = PlyFormat::big_endian;
        else if (word != "ascii")
            refuse("not a format of PLY: " + in_quotes(word));
        has_format_ = true;
    }

    void element(Words words)
    {
        const std::string_view name = words.next();
        const std::string_view count = words.next();
        const auto value = parse_integer(count);
        if (name.empty() || !value || *value < 0)
            refuse("an element takes a name and a count, and there is " + in_quotes(name) + " " +
                   in_quotes(count));
        header_.elements.push_back({std::string(name), static_cast<std::uint64_t>(*value), {}});
    }

    PlyType type(std::string_view word) const
    {
        const auto found = type_called(word);
        if (!found)
            refuse("not a type of PLY: " + in_quotes(word));
        return *found;
    }

    void property(Words words)
    {
        if (header_.elements.empty())
            refuse("a property belongs to an element, and there is none yet");
        PlyProperty result;
        std::string_view word = words.next();
        if (word == "list") {
            result.is_list = true;
            result.count_type = type(words.next());
            if (!is_integer(result.count_type))
                refuse("the length of a list is an integer, and its type here is not");
            word = words.next();
        }
        result.type = type(word);
        result.name = words.next();
        header_.elements.back().properties.push_back(result);
    }

    std::string_view bytes_, rest_;
    const std::string& name_;
    std::string_view line_end_ = "\n";
    std::size_t number_ = 0;
    bool has_format_ = false;
    PlyHeader header_;
};

}  // namespace

std::size_t ply_size(PlyType type)
{
    switch (type) {
        case PlyType::int8:
        case PlyType::uint8:
            return 1;
        case PlyType::int16:
        case PlyType::uint16:
            return 2;
        case PlyType::float64:
            return 8;
        default:
            return 4;
    }
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

PlyHeader read_ply_header(std::string_view bytes, const std::string& name)
{
    return PlyHeaderReader(bytes, name).read();
}

}  // namespace bvhbench
