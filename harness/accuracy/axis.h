// SPDX-License-Identifier: MIT
//
// Axes of accuracy. An axis has one question, answered by several methods over several inputs; it measures each method's run
// time and its number of errors against an exact reference. docs/accuracy.md describes the references.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "builders/orders.h"
#include "collide/pairs.h"
#include "geometry/mesh.h"
#include "harness/base/terminal.h"
#include "harness/measure/engine.h"
#include "harness/measure/frame_verdict.h"
#include "harness/measure/pipeline.h"
#include "harness/measure/run.h"
#include "harness/record/record.h"
#include "harness/session/session.h"
#include "scenes/doubles.h"

namespace bvhbench {

constexpr const char* quick_scene = "cloth-ball:2000:4";  ///< moves, and has contacts

/// Options of an axis.
struct AxisTask {
    std::vector<std::string> scenes;  ///< empty: the axis's own scenes
    std::size_t pairs = 1'000'000;    ///< in total, for axes about pairs
    /// Pairs of a class that are in memory at a time.
    std::size_t pairs_at_once = 1u << 20;
    uint seed = 1;  ///< seed of the first piece of pairs; later pieces use the numbers after it
    int samples = 5;
    CellFilter filter;                ///< on "input/method"
    std::string separation = "none";  ///< of the axes impacts and queries, as of `collide`

    bool wants(const std::string& input, std::string_view method) const
    {
        return passes(filter, input + '/' + std::string(method));
    }
};

/// Context of an axis: where it runs and where its cells go. There is one cell for each input and method, in the tables' order.
struct AxisRun {
    Session& session;
    const AxisTask& task;
    int& order;  ///< number of the next sample
    Progress& progress;
    std::function<void(Cell&&)> add;

    /// Returns an engine that takes one warm-up sample first.
    Engine engine() const { return {session, {.samples = task.samples, .warm_up = 1}, order}; }
};

struct Axis {
    std::string_view name;      ///< the key on the command line and in result files
    std::string_view question;  ///< one line
    void (*measure_all)(const AxisRun& run) = nullptr;  ///< for an axis that is not about frames
    /// For an axis about frames: measures a frame of a scene on the device, as one object or, with `by_objects`, as the scene's
    /// objects. Called for each scene asked for, or for each of own_scenes.
    void (*measure_frame)(const AxisRun& run, const SceneFacts& scene,
                          const Input& input) = nullptr;
    const char* own_scenes = "";  ///< with spaces between; stand-ins may replace them
    bool by_objects = false;
    std::size_t most_frames = 1;  ///< of a scene, spread over all; 1: the first

    /// Adds a cell for each input and method. Without a scene or reference it adds a cell of the method "all" with the reason.
    void measure(const AxisRun& run) const;
};

/// Returns every axis, in the order in which they run.
std::span<const Axis> accuracy_axes();

/// Returns the axis `name`. Throws BadUsage with the known names if there is none.
const Axis& find_axis(std::string_view name);

// Shared by the files of the axes.

/// Returns a cell that names the axis, the method and the input.
Cell accuracy_cell(std::string_view axis, std::string_view method, SceneFacts input);

/// A method that answers an axis's question over an input.
struct AxisMethod {
    std::string name;
    BuilderChoice builder = {.name = "none"};
    ColliderChoice collider = {};
    std::function<void(Measurement&)> prepare;  ///< as `work` of Engine::prepare
};

/// Returns a method of the fastest pipeline on this kind of device, as far as is known. Pairs of triangles
/// that share a vertex are left out.
AxisMethod fastest_method(const Session& session, std::string name, std::string boxes,
                          std::string narrow, std::function<void(Measurement&)> prepare = {});

/// Adds a cell for each method that the filter accepts: prepared, sampled interleaved with the others, and judged.
void measure_methods(const AxisRun& run, std::string_view axis, const SceneFacts& input,
                     std::span<const AxisMethod> methods);

/// Writes the verdict of a comparison with `reference`: `counted` if the method may give wrong answers, else by `wrong`, which
/// says what is wrong and is empty if nothing is.
void judge(Cell& cell, std::string_view reference, bool must_be_right, const std::string& wrong);

/// As above, by the cell's counters missed_count and false_count; by what the narrow phase, which may be "none", promises: nothing wrong
/// or nothing missed.
void judge_contacts(Cell& cell, std::string_view reference, std::string_view narrow);

/// As above, by the cell's counters missed_count and false_count.
void judge_errors(Cell& cell, std::string_view reference, bool must_be_right);

/// Counts of triangles with equal codes.
struct CodeCounts {
    std::size_t duplicates = 0;   ///< triangles whose code an earlier triangle has
    std::size_t longest_run = 0;  ///< most triangles with one code
};

/// Counts equal codes of an order that has codes. `objects` cover all faces; each has its own grid, or all share one. Codes are
/// compared within an object, by the bits that remain beside the object's number.
CodeCounts code_counts(const OrderEntry& order, std::span<const Point> points,
                       std::span<const Face> faces, std::span<const FaceRange> objects,
                       GridOver grid = GridOver::object);

/// Returns the longest side of the bounding box of at least one point.
double longest_side(std::span<const Point> points);

/// Returns a scene in doubles, like those of simulations: `points` rotated, then moved along all axes by `sizes` times the
/// longest side of their bounding box, computed in double.
std::vector<WidePoint> turned_and_moved(std::span<const Point> points, double sizes);

/// Returns the points rounded to floats, as a file of floats stores them.
std::vector<Point> rounded(const std::vector<WidePoint>& points, Doubles how);

/// Returns the points on a grid of 2^bits positions along the longest side of their bounding box, as a fixed-point format of `bits`
/// bits stores them: each coordinate is rounded to the nearest position and then to a float.
std::vector<Point> on_a_grid(std::span<const Point> points, unsigned bits);

/// A method of the axis sums: a way to add up the surface area cost (SAH) of a tree.
struct SumMethod {
    std::string_view name;
    /// Returns the cost with the default node costs. The root must have an area.
    long double (*cost)(const HostTree& tree);
    bool is_ours = false;  ///< the method that the counter sah_cost uses
};

/// Returns all methods, in the tables' order.
std::span<const SumMethod> sum_methods();

/// Returns the reference cost: areas and sums in long double (64-bit significand on x86).
long double cost_in_long_double(const HostTree& tree);

/// Judges what a pipeline found after all samples.
using JudgePipeline = std::function<void(const Pipeline& pipeline, Cell& cell)>;

/// Prepares a pipeline of the cell's builder and collider over `input`, which must outlive it. `judge` runs after sampling.
void prepare_pipeline(Session& session, const Input& input, Measurement& one,
                      const JudgePipeline& judge);

/// Points that were rounded, and the input over them.
struct RoundedInput {
    std::vector<Point> points;
    Input input;
};

/// Uploads points with the faces of `input`.
std::shared_ptr<RoundedInput> upload_rounded(Session& session, std::vector<Point> points,
                                             const Input& input);

void measure_narrow(const AxisRun& run);
void measure_swept(const AxisRun& run);
void measure_impacts(const AxisRun& run);
void measure_distance(const AxisRun& run);
void measure_queries(const AxisRun& run);
void measure_sums(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_codes(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_input(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_place(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_boxes(const AxisRun& run, const SceneFacts& scene, const Input& input);
void measure_frames(const AxisRun& run, const SceneFacts& scene, const Input& input);

}  // namespace bvhbench
