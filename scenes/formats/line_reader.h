// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "scenes/formats/formats.h"

namespace bvhbench {

/// What readers of text have in common that goes by lines: refusals name the file and the line last read.
class LineReader {
public:
    LineReader(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

protected:
    [[noreturn]] void refuse(const std::string& what) const;

    /// The three numbers that `words` begin with; refuses what does not with `otherwise` and the words.
    std::array<FileNumber, 3> point(std::string_view words, const char* otherwise) const;
    void add_vertex(std::string_view words);

    /// What was read. One object, named or not, is all faces.
    FileMesh result();

    Lines lines_;
    const std::string& name_;
    FileMesh file_;
    std::size_t first_face_ = 0;  ///< of the object that is being read
    std::vector<uint> corners_;   ///< of the face that is being read
};

}  // namespace bvhbench
