// SPDX-License-Identifier: MIT
//
// One scene on several ranks: what `cluster` measures, and an entry of an experiment's `clusters`.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cluster/halo.h"
#include "cluster/partition.h"
#include "geometry/names.h"
#include "harness/base/json_keys.h"
#include "harness/choice/scene_choice.h"

namespace bvhbench {

/// What the pairs are compared with: those that one device finds in the whole scene, or those of the other partition and of
/// brute force over a sample. Automatic: the first if a device can hold the scene.
enum class ClusterCheck { automatic, one_device, partitions };

inline constexpr std::string_view cluster_check_names[] = {"auto", "one-device", "partitions"};

struct ClusterTask {
    static constexpr unsigned most_ranks = 4096, most_boxes = 4096;
    static constexpr int most_frames_timed = 10000;
    static constexpr double most_rebalance = 1e6;

    std::string experiment = "cluster";
    std::string scene;
    unsigned ranks = 0;      ///< processes; 0: this process is one of those that are there
    unsigned simulates = 0;  ///< ranks that are counted and not run; 0: ranks run
    PartitionBy partition = PartitionBy::rcb;
    PipelineChoice pipeline = {{.name = "oibvh-multi"}, {.name = "leaf"}};
    ClusterCheck check = ClusterCheck::automatic;
    unsigned boxes = usual_top_boxes;  ///< that a rank tells the others
    FrameRange frames;                 ///< of the scene; of several, each is a sample
    double rebalance = 1.1;  ///< work of a rank, divided by the mean, above which rcb cuts anew
    int samples = 5;
    std::uint64_t most_gathered = 100'000'000;  ///< pairs that the first rank lists
    bool wants_pairs = false;                   ///< it lists them however many there are
    bool wants_contacts = false;                ///< the same of contacts
    bool share_devices = false;                 ///< whether ranks of a host may have one device
    /// Of an entry of an experiment: the words of `cluster` that ask for it, without --samples.
    std::vector<std::string> words = {};

    bool moves() const { return frames != FrameRange{}; }
    bool is_within() const { return pipeline.collider.is_within(); }
    bool has_narrow() const { return is_within() || pipeline.collider.narrow != "none"; }
};

/// Throws BadUsage for what can be on no device, before any process is started.
void check_task(const ClusterTask& task);

/// Reads an entry of an experiment: an object whose keys are the options of `cluster`. Throws BadUsage.
ClusterTask cluster_task_of(const Json& json, const std::string& experiment);

}  // namespace bvhbench
