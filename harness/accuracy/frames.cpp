// SPDX-License-Identifier: MIT
//
// The axis frames: whole frames, from vertices to contacts, with one setting that rounds, against the exact contacts of the
// vertices as given.
#include "builders/box_format.h"
#include "collide/narrow/narrow_methods.h"
#include "collide/oracles/box_pairs.h"
#include "collide/oracles/exact_reference.h"
#include "harness/accuracy/axis.h"
#include "harness/accuracy/error_sizes.h"

namespace bvhbench {
namespace {

/// How a frame is computed. The defaults round nothing.
struct FrameSetting {
    std::string method;
    std::string narrow = "exact";
    std::string boxes = "f32";
    unsigned input_bits = 0;  ///< of a coordinate; 0: as given
};

/// Returns the exact setting, those that differ from it in one way, and one that rounds in each.
std::vector<FrameSetting> frame_settings()
{
    std::vector<FrameSetting> settings = {{.method = "exact"}};
    const auto add_narrow = [&](const std::string& name) {
        settings.push_back({.method = "narrow " + name, .narrow = name});
    };
    for (const NarrowMethod& method : narrow_methods(NarrowOf::moment))
        if (!method.is_exact)
            add_narrow(std::string(method.name));
    add_narrow("none");
    for (const BoxFormat& format : box_formats().subspan(1)) {  // floats are first
        const std::string name(format.name);
        settings.push_back({.method = "boxes " + name, .boxes = name});
    }
    for (const unsigned bits : {20u, 16u, 12u, 8u})
        settings.push_back(
            {.method = "input " + std::to_string(bits) + " bits", .input_bits = bits});
    settings.push_back(
        {.method = "all coarse", .narrow = "guigue-f32", .boxes = "u16", .input_bits = 12});
    return settings;
}

}  // namespace

/// Measures what the frame takes and which contacts are wrong. Only the input's rounding and the narrow phase can make contacts
/// wrong: boxes of fewer bits are rounded outward. Sizes of errors are shares of the longest side of the frame's box, as steps of input
/// bits are.
void measure_frames(const AxisRun& run, const SceneFacts& scene, const Input& input)
{
    std::vector<FrameSetting> settings = frame_settings();
    std::erase_if(settings, [&](const FrameSetting& setting) {
        return !run.task.wants(scene.name, setting.method);
    });
    if (settings.empty())
        return;
    const PairList right = intersecting_pairs(
        input.points, input.faces, touching_pairs(input.points, input.faces, false).pairs(), false);
    std::vector<AxisMethod> methods;
    for (const FrameSetting& setting : settings) {
        const auto prepare = [&](Measurement& one) {
            const auto rounded =
                setting.input_bits == 0
                    ? nullptr
                    : upload_rounded(run.session, on_a_grid(input.points, setting.input_bits),
                                     input);
            // The judge keeps the rounded input until all samples are taken.
            const auto judge = [&, rounded](const Pipeline& pipeline, Cell& cell) {
                const PairList found(pipeline.contacts());
                count_errors(found, right, cell);
                ErrorSizes sizes;
                sizes.add(found, right, input.points, input.faces, longest_side(input.points));
                sizes.put(cell);
                cell.check.contacts_hash = found.hash();
                cell.counters["right_contacts_count"] = static_cast<double>(right.size());
                if (setting.input_bits == 0)
                    judge_contacts(cell, "CGAL boxes, CGAL", setting.narrow);
                else
                    judge_errors(cell, "CGAL boxes, CGAL", false);
            };
            prepare_pipeline(run.session, rounded ? rounded->input : input, one, judge);
        };
        methods.push_back(
            fastest_method(run.session, setting.method, setting.boxes, setting.narrow, prepare));
    }
    measure_methods(run, "frames", scene, methods);
}

}  // namespace bvhbench
