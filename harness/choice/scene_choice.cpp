// SPDX-License-Identifier: MIT
#include "harness/choice/scene_choice.h"

#include <algorithm>

#include "builders/orders.h"
#include "geometry/error.h"

namespace bvhbench {

FrameRange frame_range(const std::string& text)
{
    const std::size_t colon = std::min(text.find(':'), text.size());
    const auto number = [&](const std::string& digits) -> std::size_t {
        if (digits.empty() || digits.size() > 9 ||
            digits.find_first_not_of("0123456789") != digits.npos)
            throw BadUsage("frames are given as a:b, from a to before b, not as '" + text + "'");
        return std::stoul(digits);
    };
    const std::size_t first = number(text.substr(0, colon));
    if (colon == text.size())
        return {first, first + 1};
    const std::string end = text.substr(colon + 1);
    const FrameRange range{first, end.empty() ? 0 : number(end)};
    if (!end.empty() && range.end <= first)
        throw BadUsage("frames " + text + " are none");
    return range;
}

std::string frame_range_text(const FrameRange& range)
{
    return std::to_string(range.first) + ':' + (range.end == 0 ? "" : std::to_string(range.end));
}

void check_swept(const CollideTask& task)
{
    if (task.objects != ObjectsBy::automatic)
        throw BadUsage(
            "swept, objects are the scene's vertices, faces and edges, and nobody chooses them");
    for (const PipelineChoice& pipeline : task.pipelines) {
        if (pipeline.collider.narrow != "none")
            throw BadUsage(
                "swept boxes tell who may meet between two frames, and no narrow phase here tells "
                "who does: '" +
                pipeline.collider.narrow + "' looks at one moment");
        if (pipeline.collider.among != Among::within_objects && pipeline.builder.name != "none" &&
            find_order(pipeline.builder.order).medians != Medians::nowhere)
            throw BadUsage("order " + pipeline.builder.order +
                           " lines up one object, and swept vertices and faces are two: pairs "
                           "within objects are those of edges alone");
    }
}

}  // namespace bvhbench
