// SPDX-License-Identifier: MIT
//
// Parts of `stress` that are not one scene and one system.
#pragma once

#include <functional>
#include <optional>

#include "harness/base/pattern.h"
#include "harness/stress/systems.h"
#include "scenes/stress/stress_scene.h"

namespace bvhbench {

/// Where cells go, as they are done.
using AddStressCell = std::function<void(StressCell&&)>;

/// What is asked for: cells whose "family/scene/system" the filter matches.
struct StressTask {
    StressSize size;
    std::optional<Pattern> filter;

    bool wants(const StressCell& cell) const
    {
        return !filter || filter->is_in(cell.family + '/' + cell.scene + '/' + cell.system);
    }
};

/// The formulas of the layout up to 2^31 leaves, in arithmetic alone.
void stress_layout(const StressTask& task, const AddStressCell& add);

/// Every group size that a parameter may have on this device, in sessions of their own.
void stress_group_sizes(Session& session, const StressTask& task, const AddStressCell& add);

/// Past 2^24 leaves: builds one after the other, checked meanwhile by as many threads as there are cores and memory for.
void stress_large(Session& session, const StressTask& task, const StressFamily& family,
                  const StressCase& one, const AddStressCell& add);

/// A thousand builds and queries over one scene, and one hash of each system's.
void stress_repeats(Session& session, const StressTask& task, const AddStressCell& add);

}  // namespace bvhbench
