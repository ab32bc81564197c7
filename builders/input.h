// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "device/buffer.h"
#include "device/queue.h"
#include "geometry/mesh.h"
#include "geometry/moving_query.h"
#include "geometry/swept_box.h"

namespace bvhbench {

/// Vertices at the start and end of a step in doubles, for the narrow phase between two frames. `points` and `end_points` of the input
/// are the floats nearest to them. Rounding to nearest keeps the order of coordinates, so boxes of floats overlap wherever those of
/// doubles do, and no pair is lost.
struct WideStep {
    std::span<const WidePoint> points = {}, end_points = {};
    Buffer<WidePoint> device_points = {}, device_end_points = {};
};

/// Triangles to build over, on the host and on the device. The harness moves them; that is never timed. Builders that run on
/// the device alone do not read the host copies, which library callers may leave empty.
struct Input {
    std::span<const Point> points;
    std::span<const Face> faces;
    Buffer<Point> device_points;
    Buffer<Face> device_faces;
    std::vector<FaceRange>
        objects;  ///< Ranges of faces, one tree each; at least one, and together all faces in order.
    Buffer<uint> device_owners;  ///< Object of each face; a single word if there is one object.

    /// The same vertices in the next frame, if boxes are swept: a swept box contains the path of its triangle between the
    /// frames. Empty if boxes are of one frame.
    std::span<const Point> end_points = {};
    Buffer<Point> device_end_points = {};

    std::vector<MemoryShare> memory = {};  ///< Memory accounting of the buffers.

    WideStep wide = {};  ///< The vertices of both frames in doubles, if they are kept.

    uint triangle_count() const { return static_cast<uint>(device_faces.size()); }
    bool is_wide() const { return !wide.points.empty(); }
    bool is_swept() const { return !end_points.empty() || device_end_points.size() > 0; }

    /// Returns the input swept from the points `low` to `high` of the device. Host points are not those: for builders and colliders of the
    /// device alone.
    Input between(const Buffer<Point>& low, const Buffer<Point>& high) const
    {
        Input swept = *this;
        swept.device_points = low;
        swept.device_end_points = high;
        swept.end_points = points;  // as many as there are, and not swept
        return swept;
    }

    /// Returns the bytes of points that boxes are computed from.
    std::size_t point_bytes() const { return device_points.bytes() + device_end_points.bytes(); }
};

/// Copies a mesh to the device. The spans must outlive the input. Empty `objects`: all faces are one object. Blocks.
Input upload(const Device& device, const Queue& queue, std::span<const Point> points,
             std::span<const Face> faces, std::span<const FaceRange> objects = {});

/// Copies the points of the next frame, so that boxes are swept from now on. Blocks.
void upload_end(Input& input, const Device& device, const Queue& queue,
                std::span<const Point> end_points);

/// Copies the vertices of both frames in doubles. Blocks.
void upload_wide(Input& input, const Device& device, const Queue& queue,
                 std::span<const WidePoint> points, std::span<const WidePoint> end_points);

/// Returns an input of other faces over the points of `input`, which are shared, not copied. Blocks.
Input upload_over(const Input& input, const Device& device, const Queue& queue,
                  std::span<const Face> faces, std::span<const FaceRange> objects = {});

/// Returns the box of `face`: of one frame, or swept if the input is.
inline Aabb leaf_box(const Input& input, Face face)
{
    const Aabb box = face_box(input.points, face);
    return input.is_swept() ? swept_box(box, face_box(input.end_points, face)) : box;
}

/// Returns the boxes of all faces.
std::vector<Aabb> leaf_boxes(const Input& input);

/// Returns the number of triangles of each object.
std::vector<uint> object_sizes(const Input& input);

}  // namespace bvhbench
