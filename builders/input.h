// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "device/buffer.h"
#include "device/queue.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// The triangles to build over, in both memories. Moving them is the harness's work and is never timed.
struct Input {
    std::span<const Point> points;
    std::span<const Face> faces;
    Buffer<Point> device_points;
    Buffer<Face> device_faces;
    std::vector<FaceRange> objects;  ///< what gets a tree of its own: at least one, together all faces in order
    Buffer<uint> device_owners;      ///< the object of each face; one word if there is one object

    std::vector<MemoryShare> memory = {};  ///< what the buffers take

    uint triangle_count() const { return static_cast<uint>(faces.size()); }
};

/// Copy a mesh to the device. The spans must outlive the input. No objects: all faces are one. Waits.
Input upload(const Device& device, const Queue& queue, std::span<const Point> points,
             std::span<const Face> faces, std::span<const FaceRange> objects = {});

/// Triangles of each object.
std::vector<uint> object_sizes(const Input& input);

}  // namespace bvhbench
