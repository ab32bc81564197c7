// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "device/buffer.h"
#include "device/queue.h"
#include "geometry/mesh.h"
#include "geometry/swept_box.h"

namespace bvhbench {

/// The triangles to build over, in both memories. Moving them is the harness's work and is never timed. What runs on the
/// device alone wants no host copies: who calls the library may have none.
struct Input {
    std::span<const Point> points;
    std::span<const Face> faces;
    Buffer<Point> device_points;
    Buffer<Face> device_faces;
    std::vector<FaceRange>
        objects;  ///< what gets a tree of its own: at least one, together all faces in order
    Buffer<uint> device_owners;  ///< the object of each face; one word if there is one object

    /// The same vertices in the next frame, where boxes are to be swept: around each triangle's way from one frame to
    /// the other. Else empty, and boxes are of one frame.
    std::span<const Point> end_points = {};
    Buffer<Point> device_end_points = {};

    std::vector<MemoryShare> memory = {};  ///< what the buffers take

    uint triangle_count() const { return static_cast<uint>(device_faces.size()); }
    bool is_swept() const { return !end_points.empty(); }

    /// Bytes of points that boxes are made from.
    std::size_t point_bytes() const { return device_points.bytes() + device_end_points.bytes(); }
};

/// Copy a mesh to the device. The spans must outlive the input. No objects: all faces are one. Waits.
Input upload(const Device& device, const Queue& queue, std::span<const Point> points,
             std::span<const Face> faces, std::span<const FaceRange> objects = {});

/// Copy where the points of `input` are in the next frame: its boxes are swept from here on. Waits.
void upload_end(Input& input, const Device& device, const Queue& queue,
                std::span<const Point> end_points);

/// Other faces over the points of `input`, which are shared and not copied again. Waits.
Input upload_over(const Input& input, const Device& device, const Queue& queue,
                  std::span<const Face> faces, std::span<const FaceRange> objects = {});

/// The box of a face over the input's points: of its frame, or swept.
inline Aabb leaf_box(const Input& input, Face face)
{
    const Aabb box = face_box(input.points, face);
    return input.is_swept() ? swept_box(box, face_box(input.end_points, face)) : box;
}

/// The boxes of all its faces.
std::vector<Aabb> leaf_boxes(const Input& input);

/// Triangles of each object.
std::vector<uint> object_sizes(const Input& input);

}  // namespace bvhbench
