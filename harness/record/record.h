// SPDX-License-Identifier: MIT
//
// Contents of a result file, format 1. The schema is results/schema/result-1.schema.json, which a test compares with this.
// record.cpp writes cells, provenance.cpp the facts of a run, result_file.cpp what is known at its end. Readers are in plots/.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "device/queue.h"
#include "harness/base/json_keys.h"
#include "harness/choice/catalog.h"
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
    std::int64_t wall_ns = 0;         ///< host's clock, of the whole sample; 0: unknown
};

/// Verdict on the correctness of a measured cell. `counted`: the method may be wrong, and the cell's counters have its errors.
struct Check {
    enum class Verdict { agrees, differs, not_checked, counted } verdict = Verdict::not_checked;
    std::string against = {};
    std::string detail = {};  ///< what differs, or why nothing was checked
    std::optional<std::uint64_t> tree_hash = {};
    std::optional<std::uint64_t> pairs_hash = {};
    std::optional<std::uint64_t> contacts_hash = {};

    /// Sets the verdict to `differs` and appends `what` to the detail.
    void find_wrong(const std::string& what)
    {
        verdict = Verdict::differs;
        detail += (detail.empty() ? "" : "; ") + what;
    }
};

/// Returns the verdict's name in result files.
constexpr std::string_view verdict_name(Check::Verdict verdict)
{
    constexpr std::string_view names[] = {"agrees", "differs", "not_checked", "counted"};
    return names[static_cast<std::size_t>(verdict)];
}

/// The triangles of a cell.
struct SceneFacts {
    std::string name;
    std::string objects_by = {};    ///< what makes an object; empty: as the scene was loaded
    std::int64_t between = 0;       ///< frames inserted between consecutive frames of the scene
    std::string exclude = {};       ///< the words of the filter of objects, as they were given
    std::uint64_t filter_hash = 0;  ///< of groups, masks and excluded objects; 0: none
    std::int64_t triangles = 0;     ///< 0: the members below are unknown
    std::int64_t vertices = 0;
    std::int64_t objects = 0;
    std::int64_t frame = 0;
    std::string source = {};
    std::string stand_in_for = {};
    Outlier outlier = {};  ///< empty name: no triangle was moved
    Rounding rounding = {};
    std::string bend_of = {};
    std::optional<MeshFacts> mesh = {};  ///< of a scene that was read from a file
    Reading reading = {};
    std::uint64_t content_hash = 0;
};

/// Query for pairs of features in place of triangles.
struct FeatureFacts {
    std::string pairs = {};  ///< vertex-face or edge-edge; empty: pairs are of triangles
    /// To which boxes are swept from SceneFacts::frame; 0: they are not.
    std::int64_t to_frame = 0;
    std::int64_t primitives = 0;  ///< number of vertices and faces, or of edges
};

/// Axis of accuracy of a cell, and the method that gave its answers.
struct AccuracyFacts {
    std::string axis = {};  ///< empty: the cell is on no axis
    std::string method = {};
    std::int64_t seed = 0;  ///< of generated input; 0: nothing was generated
};

/// How a cell was sampled.
struct SamplingFacts {
    Stopped stopped = Stopped::not_sampled;  ///< why sampling stopped
    double until = 0;                        ///< target for interquartile range / median; 0: none
    Race race = Race::none;
    Caches caches = Caches::hot;
    int dropped = 0;  ///< samples whose times could not be true
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
    SceneFacts scene = {};
    BuilderChoice builder = {};
    ColliderChoice collider = {};  ///< empty name: none
    FeatureFacts features = {};
    AccuracyFacts accuracy = {};
    Json cluster = {};  ///< of several ranks: what record/cluster_result.h has; else null
    Operation operation = Operation::build;
    Status status = Status::measured;
    std::string reason = {};  ///< why it was skipped or failed
    int warm_up = 0;          ///< samples taken first and discarded
    FirstRun first = {};
    SamplingFacts sampling = {};
    std::vector<Sample> samples = {};
    /// Keys end in the unit: nodes_count, tree_bytes.
    std::map<std::string, double> counters = {};
    /// Counters without a value, with the reason.
    std::map<std::string, std::string> left_out = {};
    /// Number of leaves per level, from the root on.
    std::vector<std::int64_t> leaves_by_depth = {};
    Check check = {};
    /// With `within`: the distance in the scene's unit, for which pairs are exact.
    std::optional<double> within_distance = {};
    /// With `separation`: the minimum separation in the scene's unit.
    std::optional<double> separation = {};
    /// With `first`: two triangles that intersect, by their numbers in the scene's file; empty: no two do.
    std::optional<std::vector<uint>> first_contact = {};
    /// Objects that lie wholly inside others, each with the name of the other (--containment).
    std::vector<std::pair<std::string, std::string>> contained = {};
};

/// Format version of written files.
inline const std::string result_format = "1.0";

/// Returns what a cell says about its scene, as one line of JSON.
std::string scene_text(const SceneFacts& scene);

/// Returns a cell as one line of JSON. Numbers that are not finite are left out.
std::string cell_text(const Cell& cell);
std::string cell_text(const StressCell& cell);

}  // namespace bvhbench
