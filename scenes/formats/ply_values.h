// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/formats/file_point.h"
#include "scenes/formats/ply_header.h"

namespace bvhbench {

/// The values behind a PLY header, one after the other, whatever the format. Throws Unavailable where the
/// file ends too soon or holds something that is no number.
class PlyValues {
public:
    PlyValues(std::string_view data, PlyFormat format, const std::string& name)
        : rest_(data), format_(format), name_(name)
    {}

    /// What is read from now on, for messages. Throws if the rest of the file cannot hold that many.
    void begin(const PlyElement& element);
    void at(std::uint64_t index) { index_ = index; }

    /// A double holds each of the eight types exactly. Beyond the floats, the nearest float is infinity, which is refused
    /// later with its vertex. Of a text whose type is a float, floats hold it, however many digits it has.
    FileNumber number(PlyType type);
    std::int64_t integer(PlyType type);
    void skip(const PlyProperty& property);
    /// After the last element. Throws if more than white space is left.
    void end() const;

    [[noreturn]] void refuse(const std::string& what) const;

private:
    std::string_view word();
    std::string_view bytes(std::uint64_t count);
    double binary(PlyType type);

    std::string_view rest_;
    PlyFormat format_;
    const std::string& name_;
    std::string element_;
    std::uint64_t index_ = 0;
    std::uint64_t count_ = 0;
};

}  // namespace bvhbench
