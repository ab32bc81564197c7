// SPDX-License-Identifier: MIT
#include "harness/choice/collide_task.h"

#include "builders/orders.h"
#include "geometry/error.h"

namespace bvhbench {

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
