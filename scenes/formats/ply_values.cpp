// SPDX-License-Identifier: MIT
#include "scenes/formats/ply_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

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

double value_of(PlyType type, const char* bytes)
{
    switch (type) {
        case PlyType::int8:
            return value_of<std::int8_t>(bytes);
        case PlyType::uint8:
            return value_of<std::uint8_t>(bytes);
        case PlyType::int16:
            return value_of<std::int16_t>(bytes);
        case PlyType::uint16:
            return value_of<std::uint16_t>(bytes);
        case PlyType::int32:
            return value_of<std::int32_t>(bytes);
        case PlyType::uint32:
            return value_of<std::uint32_t>(bytes);
        case PlyType::float32:
            return value_of<float>(bytes);
        default:
            return value_of<double>(bytes);
    }
}

/// The fewest bytes an element takes in the file.
std::uint64_t least_size(const PlyElement& element, PlyFormat format)
{
    std::uint64_t size = 0;
    for (const PlyProperty& property : element.properties)
        size += format == PlyFormat::ascii
                    ? 1
                    : ply_size(property.is_list ? property.count_type : property.type);
    return size;
}

}  // namespace

void PlyValues::refuse(const std::string& what) const
{
    throw Unavailable(name_ + ", " + element_ + " " + std::to_string(index_) + " of " +
                      std::to_string(count_) + ": " + what);
}

void PlyValues::begin(const PlyElement& element)
{
    element_ = element.name;
    index_ = 0;
    count_ = element.count;
    const std::uint64_t least = least_size(element, format_);
    if (least != 0 && element.count > rest_.size() / least)
        throw Unavailable(name_ + " ends too soon: its header says " + std::to_string(count_) +
                          " of element " + in_quotes(element_) + ", and " +
                          std::to_string(rest_.size()) + " bytes are left for them");
}

std::string_view PlyValues::word()
{
    Words words(rest_);
    const std::string_view result = words.next();
    if (result.empty())
        refuse("the file ends too soon");
    rest_ = words.rest();
    return result;
}

std::string_view PlyValues::bytes(std::uint64_t count)
{
    if (count > rest_.size())
        refuse("the file ends too soon");
    const std::string_view result = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return result;
}

double PlyValues::binary(PlyType type)
{
    const std::string_view raw = bytes(ply_size(type));
    const bool swapped = format_ == PlyFormat::big_endian;
    char ordered[8] = {};
    for (std::size_t k = 0; k < raw.size() && k < sizeof ordered; ++k)
        ordered[swapped ? raw.size() - 1 - k : k] = raw[k];
    return value_of(type, ordered);
}

FileNumber PlyValues::number(PlyType type)
{
    if (format_ == PlyFormat::ascii && !is_integer(type)) {
        const std::string_view text = word();
        const auto value = parse_number(text);
        if (!value)
            refuse("not a number: " + in_quotes(text));
        if (type == PlyType::float32)
            return {value->rounded, value->rounded, true};
        return *value;
    }
    const double value = is_integer(type) ? static_cast<double>(integer(type)) : binary(type);
    constexpr double largest = std::numeric_limits<float>::max();
    if (value > largest || value < -largest)
        return {value, std::numeric_limits<float>::infinity(), false};
    const auto rounded = static_cast<float>(value);
    return {value, rounded, double{rounded} == value || std::isnan(value)};
}

std::int64_t PlyValues::integer(PlyType type)
{
    if (format_ == PlyFormat::ascii) {
        const std::string_view text = word();
        const auto value = parse_integer(text);
        if (!value)
            refuse("not an integer: " + in_quotes(text));
        return *value;
    }
    return static_cast<std::int64_t>(binary(type));
}

void PlyValues::skip(const PlyProperty& property)
{
    const std::int64_t count = property.is_list ? integer(property.count_type) : 1;
    if (count < 0)
        refuse("a list of length " + std::to_string(count));
    if (format_ != PlyFormat::ascii) {
        bytes(static_cast<std::uint64_t>(count) * ply_size(property.type));
        return;
    }
    for (std::int64_t k = 0; k < count; ++k)
        word();
}

void PlyValues::end() const
{
    Words words(rest_);
    const std::string_view more = words.next();
    if (!more.empty())
        throw Unavailable(name_ + " has " + std::to_string(rest_.size()) +
                          " bytes more than its header says");
}

}  // namespace bvhbench
