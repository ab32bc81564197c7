// SPDX-License-Identifier: MIT
//
// Binary PLY files of which some triangles can be read without the others, because all records of an element have one size.
#pragma once

#include <filesystem>
#include <optional>

#include "geometry/mesh.h"
#include "scenes/formats/ply_header.h"

namespace bvhbench {

class PlyParts {
public:
    /// Opens a file. With `frames`, a file of positions as in scenes/sequence.h, points are those of its first frame. Nothing if
    /// the file must be read whole, which also tells what is wrong with it: if it is not little-endian, has faces that are no
    /// triangles, lists besides their corners or coordinates that are not floats, or if a file has another size than it should.
    /// Throws Unavailable if the file cannot be read.
    static std::optional<PlyParts> opened(const std::filesystem::path& path,
                                          const std::filesystem::path& frames = {});

    std::uint64_t triangles() const { return faces_.count; }

    /// Reads the triangles `run` and the points that they use. Throws Unavailable for a corner that is no vertex, a point that is
    /// not finite, and too little host memory.
    MeshRun read(FaceRange run) const;

private:
    /// Where the records of an element are.
    struct Records {
        std::filesystem::path path;
        std::uint64_t at = 0, count = 0;
        std::size_t bytes = 0;  ///< of a record
    };

    bool locate(const PlyHeader& header, std::uint64_t data_at, std::uint64_t file_size);
    bool locate_vertex(const PlyElement& element);
    bool locate_face(const PlyElement& element);
    template <class Read>
    static void each(const Records& records, std::uint64_t first, std::uint64_t count,
                     const Read& read);

    Records vertices_, faces_;
    bool has_float_points_ = true;
    std::size_t axis_at_[3] = {};  ///< of each coordinate in its record
    std::size_t corners_at_ = 0;   ///< of the list of corners in its record
    const PlyType *length_ = nullptr, *corner_ = nullptr;
};

}  // namespace bvhbench
