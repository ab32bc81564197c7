// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bvhbench {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

/// A type of values. A double holds each of the eight exactly.
struct PlyType {
    std::string_view name, other_name;
    bool is_integer;
    std::size_t size;                    ///< bytes of a value in a binary file
    double (*value)(const char* bytes);  ///< of little-endian bytes
};

struct PlyProperty {
    std::string name;
    const PlyType* type = nullptr;
    const PlyType* count_type = nullptr;  ///< of a list's length; none: one value
    std::size_t axis = 3;                 ///< of the coordinate that it is; 3: it is none

    bool is_corner_list() const;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// The fewest bytes that one takes in the file.
    std::uint64_t least_size(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;  ///< in the order their data follows
    std::string_view data;             ///< what follows the header
};

/// Throws Unavailable, beginning with `name`, when `bytes` do not begin with a PLY header.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace bvhbench
