// SPDX-License-Identifier: MIT
#pragma once

#include "harness/measure/cluster.h"

namespace bvhbench {

/// Runs the frames `task.frames` of a scene that moves, each once: triangles stay on their ranks, points move, and the scene is cut
/// anew after a frame in which a rank had too much work. Each frame's answer is compared with that of one device. Fills `found`,
/// at the first rank only. Throws as run_cluster does, and BadUsage for frames that the scene lacks.
void run_cluster_frames(HostedRanks& ranks, Session& session, const ClusterTask& task,
                        ClusterFound& found);

}  // namespace bvhbench
