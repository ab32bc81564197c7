// SPDX-License-Identifier: MIT
//
// Contents of a result file, format 1. The schema is results/schema/result-1.schema.json, which a test compares with this.
// record.cpp writes cells and the facts of a run; result_file.cpp adds what is known at its end. Readers are in plots/.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "device/queue.h"
#include "geometry/host_memory.h"
#include "harness/choice/catalog.h"
#include "harness/choice/collider_catalog.h"
#include "harness/choice/sampling.h"
#include "harness/record/finding.h"
#include "scenes/scene.h"

namespace bvhbench {

/// One timed build, refit, or whole frame.
struct Sample {
    int order = 0;  ///< position among all samples of the run, to make drift visible
    std::vector<StageTime> stages;
    std::int64_t calibration_ns = 0;  ///< mean of the calibrations before and after; 0: unknown
    bool drifted = false;             ///< whether one of the two is far from the median
};

/// Verdict on the correctness of a measured cell. `counted`: the method may be wrong, and the cell's counters have its errors.
struct Check {
    enum class Verdict { agrees, differs, not_checked, counted } verdict = Verdict::not_checked;
    std::string against;
    std::string detail;  ///< what differs, or why nothing was checked
    std::optional<std::uint64_t> tree_hash = {};
    std::optional<std::uint64_t> pairs_hash = {};
    std::optional<std::uint64_t> contacts_hash = {};
};

/// The triangles of a cell.
struct SceneFacts {
    std::string name;
    std::string objects_by = {};  ///< what makes an object; empty: as the scene was loaded
    std::int64_t between = 0;     ///< frames inserted between consecutive frames of the scene
    std::int64_t triangles = 0;   ///< 0: the members below are unknown
    std::int64_t vertices = 0;
    std::int64_t objects = 0;
    std::int64_t frame = 0;
    std::string source;
    std::string stand_in_for;
    Outlier outlier;  ///< empty name: no triangle was moved
    Rounding rounding;
    std::string bend_of;
    std::uint64_t content_hash = 0;
};

/// Query for pairs of boxes that are swept from one frame to another.
struct SweptFacts {
    std::string pairs;            ///< vertex-face or edge-edge; empty: boxes are not swept
    std::int64_t to_frame = 0;    ///< frame of the end; SceneFacts::frame is that of the start
    std::int64_t primitives = 0;  ///< number of vertices and faces, or of edges
};

/// Axis of accuracy of a cell, and the method that gave its answers.
struct AccuracyFacts {
    std::string axis;  ///< empty: the cell is on no axis
    std::string method;
    std::int64_t seed = 0;  ///< of generated input; 0: nothing was generated
};

/// How a cell was sampled.
struct SamplingFacts {
    Stopped stopped = Stopped::not_sampled;  ///< why sampling stopped
    double until = 0;                        ///< target for interquartile range / median; 0: none
    Race race = Race::none;
    bool cold = false;  ///< whether caches were emptied before each sample
};

/// Times before the first sample, on the host's clock.
struct FirstRun {
    std::int64_t compile_ns = 0;  ///< compilation of the cell's kernels; 0: already compiled
    std::int64_t run_ns = 0;      ///< first build, or frames until buffers sufficed; 0: unknown
};

/// Everything known about one builder, or builder and collider, over one scene.
struct Cell {
    enum class Status { measured, skipped, failed };

    std::string experiment;
    SceneFacts scene;
    BuilderChoice builder;
    ColliderChoice collider;  ///< empty name: none
    SweptFacts swept;
    AccuracyFacts accuracy;
    Operation operation = Operation::build;
    Status status = Status::measured;
    std::string reason;  ///< why it was skipped or failed
    int warm_up = 0;     ///< samples taken first and discarded
    FirstRun first = {};
    SamplingFacts sampling = {};
    std::vector<Sample> samples;
    std::map<std::string, double> counters;       ///< keys end in the unit: nodes_count, tree_bytes
    std::map<std::string, std::string> left_out;  ///< counters without a value, with the reason
    std::vector<std::int64_t> leaves_by_depth;    ///< number of leaves per level, from the root on
    Check check;
};

/// Settings of the host that distort times. Empty values are unknown.
struct HostConditions {
    std::string governor;       ///< of the first core without "performance", else that
    std::optional<bool> turbo;  ///< whether cores may exceed their base clock
    std::optional<bool> on_battery;
    std::optional<double> load;         ///< runnable processes, mean over the last minute
    std::vector<std::string> warnings;  ///< one sentence for each setting that distorts times

    bool operator==(const HostConditions&) const = default;
};

struct DeviceFacts {
    std::string name, platform, driver, opencl, opencl_c;
    std::string kind;  ///< cpu, gpu or other
    std::int64_t compute_units = 0;
    std::int64_t global_memory_bytes = 0;
    std::int64_t max_allocation_bytes = 0;
    std::int64_t local_memory_bytes = 0;
    std::int64_t max_group_size = 0;
    std::int64_t timer_resolution_ns = 0;
    bool correctly_rounded_division = false;
    bool device_scope_acq_rel_atomics = false;
};

/// Machine, program and settings of a run.
struct RunFacts {
    std::string id, started_at;
    std::vector<std::string> command;
    std::string version, commit, build_type, compiler, arch, kernels;
    bool dirty = false;
    std::string host_name, host_cpu, host_os;
    int host_threads = 0;
    DeviceFacts device;
    std::map<std::string, std::string> libraries;  ///< versions by library name
    double copy_rate_bytes_per_s = 0;              ///< 0: not measured
    std::int64_t copy_rate_buffer_bytes = 0;
    double launch_cost_ns = 0;           ///< 0: not measured
    std::string tuning_from = "none";    ///< file of the tuned values
    std::map<std::string, uint> tuning;  ///< parameters that differ from their defaults
    std::int64_t compile_ns = 0;
    NodeCosts costs;  ///< costs in the counters sah_cost and epo
    HostConditions conditions = {};
    std::map<std::string, std::string> test_hooks = {};  ///< not empty: not a valid result
};

/// Format version of written files.
inline const std::string result_format = "1.10";

/// Returns a run or a cell as one line of JSON. Numbers that are not finite are left out.
std::string run_text(const RunFacts& run);
std::string cell_text(const Cell& cell);
std::string cell_text(const StressCell& cell);

/// Returns the text of a result file from the texts of its parts, with one cell per line, so that files can be compared by diff.
std::string document_text(const std::string& run, const std::vector<std::string>& cells,
                          const std::vector<std::string>& stress = {});

}  // namespace bvhbench
