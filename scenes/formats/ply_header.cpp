// SPDX-License-Identifier: MIT
#include "scenes/formats/ply_header.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "geometry/error.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
double value_of(const char* bytes)
{
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

constexpr PlyType types[] = {
    {"char", "int8", true, 1, value_of<std::int8_t>},
    {"uchar", "uint8", true, 1, value_of<std::uint8_t>},
    {"short", "int16", true, 2, value_of<std::int16_t>},
    {"ushort", "uint16", true, 2, value_of<std::uint16_t>},
    {"int", "int32", true, 4, value_of<std::int32_t>},
    {"uint", "uint32", true, 4, value_of<std::uint32_t>},
    {"float", "float32", false, 4, value_of<float>},
    {"double", "float64", false, 8, value_of<double>},
};

constexpr std::string_view formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

class HeaderReader {
public:
    HeaderReader(std::string_view bytes, const std::string& name)
        : bytes_(bytes), rest_(bytes), name_(name)
    {
        // The first line shows how lines end. This matters for the last line, because binary data may begin with a newline.
        const std::size_t end = bytes.find_first_of("\r\n");
        if (end != bytes.npos && bytes[end] == '\r')
            line_end_ = bytes.substr(end, 2) == "\r\n" ? "\r\n" : "\r";
    }

    PlyHeader read()
    {
        std::string_view first = line();
        if (next_word(first) != "ply")
            refuse("a PLY file begins with ply, and there is " + in_quotes(bytes_.substr(0, 8)));
        while (statement(line())) {
        }
        if (!has_format_)
            refuse("the header names no format");
        header_.data = rest_;
        return std::move(header_);
    }

private:
    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Unavailable(name_ + ", line " + std::to_string(number_) + ": " + what);
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

    /// Parses one line of the header. False at the end of the header.
    bool statement(std::string_view words)
    {
        const std::string_view keyword = next_word(words);
        if (keyword == "format")
            format(next_word(words));
        else if (keyword == "element")
            element(words);
        else if (keyword == "property")
            property(words);
        else if (keyword != "comment" && keyword != "obj_info" && keyword != "end_header" &&
                 !keyword.empty())
            refuse("not a word of a PLY header: " + in_quotes(keyword));
        return keyword != "end_header";
    }

    void format(std::string_view word)
    {
        const auto found = std::ranges::find(formats, word);
        if (found == std::end(formats))
            refuse("not a format of PLY: " + in_quotes(word));
        header_.format = static_cast<PlyFormat>(found - formats);
        has_format_ = true;
    }

    void element(std::string_view words)
    {
        const std::string_view name = next_word(words), count = next_word(words);
        const auto value = parse_integer(count);
        if (name.empty() || !value || *value < 0)
            refuse("an element takes a name and a count, and there is " + in_quotes(name) + " " +
                   in_quotes(count));
        header_.elements.push_back({std::string(name), static_cast<std::uint64_t>(*value), {}});
    }

    const PlyType* type(std::string_view word) const
    {
        for (const PlyType& type : types)
            if (word == type.name || word == type.other_name)
                return &type;
        refuse("not a type of PLY: " + in_quotes(word));
    }

    void property(std::string_view words)
    {
        if (header_.elements.empty())
            refuse("a property belongs to an element, and there is none yet");
        PlyProperty result;
        std::string_view word = next_word(words);
        if (word == "list") {
            result.count_type = type(next_word(words));
            if (!result.count_type->is_integer)
                refuse("the length of a list is an integer, and its type here is not");
            word = next_word(words);
        }
        result.type = type(word);
        result.name = next_word(words);
        if (result.count_type == nullptr && result.name.size() == 1)
            result.axis = std::min<std::size_t>(std::string_view("xyz").find(result.name), 3);
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

bool PlyProperty::is_corner_list() const
{
    return count_type != nullptr && (name == "vertex_indices" || name == "vertex_index");
}

std::uint64_t PlyElement::least_size(PlyFormat format) const
{
    std::uint64_t size = 0;
    for (const PlyProperty& property : properties)
        size += format == PlyFormat::ascii ? 1
                : property.count_type      ? property.count_type->size
                                           : property.type->size;
    return size;
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name)
{
    return HeaderReader(bytes, name).read();
}

}  // namespace bvhbench
