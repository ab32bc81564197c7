// SPDX-License-Identifier: MIT
//
// What a result file says, format 1. The schema is results/schema/result-1.schema.json; a test holds the
// two together. record.cpp is the only writer; the readers are in plots/.
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

/// One timed build, refit, or build and query.
struct Sample {
    int order = 0;  ///< position in the whole run, so that drift can be seen
    std::vector<StageTime> stages;
    std::int64_t calibration_ns = 0;  ///< what the calibration took around it; 0: not known
    bool drifted = false;             ///< whether that was far from its median
};

/// Whether what was measured was also right. A cell that was not checked says so; one that promises no right answer
/// counts how many are wrong.
struct Check {
    enum class Verdict { agrees, differs, not_checked, counted } verdict = Verdict::not_checked;
    std::string against;
    std::string detail;  ///< what differs, or why nothing was checked
    std::optional<std::uint64_t> tree_hash = {};
    std::optional<std::uint64_t> pairs_hash = {};
    std::optional<std::uint64_t> contacts_hash = {};
};

/// Which triangles were built over.
struct SceneFacts {
    std::string name;
    std::string objects_by = {};  ///< what is an object; empty: as the scene was loaded
    std::int64_t between = 0;     ///< frames put between each two of the scene's
    std::int64_t triangles = 0;   ///< the rest is known only if this is not 0
    std::int64_t vertices = 0;
    std::int64_t objects = 0;
    std::int64_t frame = 0;
    std::string source;
    std::string stand_in_for;
    Outlier outlier;  ///< of an empty name: no triangle was moved
    Rounding rounding;
    std::string bend_of;
    std::uint64_t content_hash = 0;
};

/// Which pairs a step between two frames was asked for, over boxes swept from one to the other.
struct SweptFacts {
    std::string pairs;            ///< vertex-face or edge-edge; empty: boxes are of one frame
    std::int64_t to_frame = 0;    ///< the scene's `frame` is where the step begins
    std::int64_t primitives = 0;  ///< vertices and faces, or edges
};

/// Which axis of accuracy a cell is on, and by what its answers came about.
struct AccuracyFacts {
    std::string axis;  ///< empty: none
    std::string method;
    std::int64_t seed = 0;  ///< of what was generated; 0: nothing was
};

/// How a cell's samples were taken.
struct SamplingFacts {
    Stopped stopped = Stopped::not_sampled;  ///< why there are no more
    double until = 0;                        ///< the relative quartile range asked for; 0: none
    bool cold = false;                       ///< whether caches were emptied before each
};

/// What is over before the first sample: on the host's clock.
struct FirstRun {
    std::int64_t compile_ns = 0;  ///< kernels compiled for the cell; 0 if they were there
    std::int64_t run_ns = 0;      ///< the first build, or frames until there was room; 0: not known
};

/// Everything known about one builder on one scene.
struct Cell {
    enum class Status { measured, skipped, failed };

    std::string experiment;
    SceneFacts scene;
    BuilderChoice builder;
    ColliderChoice collider;  ///< of an empty name: none
    SweptFacts swept;
    AccuracyFacts accuracy;
    Operation operation = Operation::build;
    Status status = Status::measured;
    std::string reason;  ///< why it was skipped or failed
    int warm_up = 0;     ///< samples taken first and thrown away
    FirstRun first = {};
    SamplingFacts sampling = {};
    std::vector<Sample> samples;
    std::map<std::string, double> counters;  ///< the unit ends the key: nodes_count, tree_bytes
    std::map<std::string, std::string> left_out;  ///< a counter without a value, and why
    std::vector<std::int64_t> leaves_by_depth;    ///< from the root's level on
    Check check;
};

/// Settings of the host that distort times. An empty value is unknown.
struct HostConditions {
    std::string governor;       ///< of the first core whose is not "performance", else that
    std::optional<bool> turbo;  ///< whether cores may clock higher for a while
    std::optional<bool> on_battery;
    std::optional<double> load;         ///< processes that wanted to run, mean of the last minute
    std::vector<std::string> warnings;  ///< sentences on those that matter

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

/// The circumstances of a run.
struct RunFacts {
    std::string id, started_at;
    std::vector<std::string> command;
    std::string version, commit, build_type, compiler, arch, kernels;
    bool dirty = false;
    std::string host_name, host_cpu, host_os;
    int host_threads = 0;
    DeviceFacts device;
    std::map<std::string, std::string> libraries;  ///< name to version
    double copy_rate_bytes_per_s = 0;              ///< 0: not measured
    std::int64_t copy_rate_buffer_bytes = 0;
    double launch_cost_ns = 0;           ///< 0: not measured
    std::string tuning_from = "none";    ///< the file of the values below
    std::map<std::string, uint> tuning;  ///< parameter to value, where it is not the default
    std::int64_t compile_ns = 0;
    NodeCosts costs;  ///< in the counters sah_cost and epo
    HostConditions conditions = {};
    std::map<std::string, std::string> test_hooks = {};  ///< of any: this is no result
};

/// The format that is written.
inline const std::string result_format = "1.9";

/// JSON of a run and of a cell, each on one line. A number that is not finite is left out.
std::string run_text(const RunFacts& run);
std::string cell_text(const Cell& cell);
std::string cell_text(const StressCell& cell);

/// The text of a file from its parts' texts: a cell a line, so that files can be compared.
std::string document_text(const std::string& run, const std::vector<std::string>& cells,
                          const std::vector<std::string>& stress = {});

}  // namespace bvhbench
