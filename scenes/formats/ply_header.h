// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bvhbench {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

/// Type of a value. A double can hold all values of each of the eight types.
struct PlyType {
    std::string_view name, other_name;
    bool is_integer;
    std::size_t size;                    ///< bytes per value in a binary file
    double (*value)(const char* bytes);  ///< decodes little-endian bytes
};

struct PlyProperty {
    std::string name;
    const PlyType* type = nullptr;
    const PlyType* count_type = nullptr;  ///< type of a list's length; null: a single value
    std::size_t axis = 3;  ///< axis of the coordinate that the property holds; 3: not a coordinate

    bool is_corner_list() const;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Smallest number of bytes that one element takes in the file.
    std::uint64_t least_size(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;  ///< in the order of their data
    std::string_view data;             ///< the bytes after the header
};

/// Parses a PLY header. Throws Unavailable, with a message that begins with `name`, if `bytes` do not begin with one.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace bvhbench
