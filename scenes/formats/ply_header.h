// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bvhbench {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyFormat { ascii, little_endian, big_endian };

/// Of a value in a binary file, in bytes.
std::size_t ply_size(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;  ///< in the order their data follows
    std::size_t size = 0;              ///< bytes before the data
};

/// Throws Unavailable, beginning with `name`, when `bytes` do not begin with a PLY header.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace bvhbench
