// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "scenes/formats/formats.h"

namespace bvhbench {

/// Base of the line-based text readers. Error messages name the file and the line last read.
class LineReader {
public:
    LineReader(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

protected:
    [[noreturn]] void refuse(const std::string& what) const;

    /// Returns the three numbers at the front of `words`; throws with `otherwise` and the words if they are missing.
    std::array<FileNumber, 3> point(std::string_view words, const char* otherwise) const;
    void add_vertex(std::string_view words);

    /// Returns the mesh. If there is only one object, named or not, it covers all faces.
    FileMesh result();

    Lines lines_;
    const std::string& name_;
    FileMesh file_;
    std::size_t first_face_ = 0;  ///< first face of the current object
    std::vector<uint> corners_;   ///< corners of the current face
};

}  // namespace bvhbench
