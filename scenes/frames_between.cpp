// SPDX-License-Identifier: MIT
#include "scenes/frames_between.h"

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "scenes/finish.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

std::vector<Point> blend(const std::vector<Point>& from, const std::vector<Point>& to, double t)
{
    const auto mix = [t](double a, double b) { return static_cast<float>((1 - t) * a + t * b); };
    std::vector<Point> points;
    points.reserve(from.size());
    for (std::size_t k = 0; k < from.size(); ++k)
        points.push_back(
            {mix(from[k].x, to[k].x), mix(from[k].y, to[k].y), mix(from[k].z, to[k].z)});
    return points;
}

}  // namespace

Scene with_frames_between(Scene scene, uint between)
{
    if (between == 0)
        return scene;
    if (scene.frames.size() < 2)
        throw BadUsage("scene '" + scene.name + "' has one frame, and none lies between");
    const std::uint64_t parts = std::uint64_t{between} + 1;
    const std::uint64_t frames = (scene.frames.size() - 1) * parts + 1;
    require_host_memory("scene " + in_quotes(scene.name) + " with the frames between",
                        frames * scene.frames.front().size() * sizeof(Point));

    std::vector<std::vector<Point>> all;
    std::vector<std::string> labels;
    for (std::uint64_t k = 0; k < frames; ++k) {
        const std::size_t before = k / parts;
        const std::uint64_t part = k % parts;
        if (!scene.frame_labels.empty())
            labels.push_back(
                scene.frame_labels[before] +
                (part == 0 ? "" : "+" + std::to_string(part) + "/" + std::to_string(parts)));
        if (part != 0)
            all.push_back(blend(scene.frames[before], scene.frames[before + 1],
                                static_cast<double>(part) / static_cast<double>(parts)));
        else
            all.push_back(scene.frames[before]);
    }
    scene.frames = std::move(all);
    scene.frame_labels = std::move(labels);
    scene.folder.clear();  // whose frames are further apart
    return finished(std::move(scene));
}

}  // namespace bvhbench
