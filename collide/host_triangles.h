// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "builders/input.h"
#include "device/queue.h"

namespace bvhbench {

/// Points and faces of an input on the host: its own, or copies of the device's where it has none. Valid as long as the input. Blocks.
class HostTriangles {
public:
    HostTriangles(const Input& input, const Queue& queue) : points(input.points), faces(input.faces)
    {
        if (!points.empty())
            return;
        points = points_ = input.device_points.download(queue.cl());
        faces = faces_ = input.device_faces.download(queue.cl());
    }
    HostTriangles(const HostTriangles&) = delete;
    HostTriangles& operator=(const HostTriangles&) = delete;

    std::span<const Point> points;
    std::span<const Face> faces;

private:
    std::vector<Point> points_;
    std::vector<Face> faces_;
};

}  // namespace bvhbench
