// SPDX-License-Identifier: MIT
//
// What a pipeline counted in its last frame, and the times of what no stage includes.
#include <algorithm>

#include "geometry/host_memory.h"
#include "harness/measure/engine.h"
#include "harness/measure/pipeline.h"

namespace bvhbench {
constexpr std::int64_t most_copying_ns = 200'000'000;  ///< after which a copy is not timed again

void Pipeline::upload(const Input& input) const
{
    const cl::CommandQueue& queue = session_.queue().cl();
    Buffer<Point> points = input.device_points, end_points = input.device_end_points;
    points.upload(queue, input.points);
    end_points.upload(queue, input.end_points);
    WideStep wide = input.wide;
    wide.device_points.upload(queue, wide.points);
    wide.device_end_points.upload(queue, wide.end_points);
}

void Pipeline::read_back() const { has_contacts() ? contacts() : pairs(); }

std::map<std::string, double> Pipeline::transfers(const Input& input) const
{
    if (!is_on_device())
        return {};
    const auto median_ns = [](const std::function<void()>& copy) {
        copy();  // the first one may touch new memory
        std::vector<std::int64_t> times;
        std::int64_t all = 0;
        for (int k = 0; k < 5 && all < most_copying_ns; ++k)
            all += times.emplace_back(host_ns(copy));
        std::ranges::sort(times);
        return static_cast<double>(times[times.size() / 2]);
    };
    std::map<std::string, double> times = {{"upload_ns", median_ns([&] { upload(input); })}};
    const auto answer = counters().at(has_contacts() ? "contacts_count" : "pairs_count");
    if (answer * sizeof(Pair) < static_cast<double>(host_memory_left()))
        times["read_back_ns"] = median_ns([&] { read_back(); });
    return times;
}

std::map<std::string, double> Pipeline::counters() const
{
    std::map<std::string, double> counters;
    const auto put = [&](const char* name, auto value) {
        counters[name] = static_cast<double>(value);
    };
    const Queue& queue = session_.queue();
    QueryCounts counts;
    if (queries())
        counts = collider_->counts(queue);
    else
        counts.box_tests = counts.tasks = 0;
    if (entering_ && updates_.front() != TreeUpdate::keep && counts.box_tests)
        *counts.box_tests += near_->box_tests(queue);
    if (!is_plain()) {
        counts.box_tests =
            listed_ + (does_ == MarginFrame::served ? 0 : counts.box_tests.value_or(0));
        counts.pairs = pair_count();
        put("listed_count", listed_);
    }
    put(collider_->finds_contacts() ? "contacts_count" : "pairs_count", counts.pairs);
    if (counts.box_tests)
        put("box_tests_count", *counts.box_tests);
    if (counts.bvtt_peak)
        put("bvtt_peak_count", *counts.bvtt_peak);
    if (counts.tasks)
        put("tasks_count", *counts.tasks);
    for (const auto& [name, value] : counts.more)
        put(std::string(name).c_str(), value);
    const auto updated = [&](TreeUpdate how) {
        const auto objects = static_cast<std::size_t>(std::ranges::count(updates_, how));
        const bool has_some = objects > 0 && queries();
        return !entering_ ? objects : has_some ? entering_->input.objects.size() : 0;
    };
    std::size_t memory = 0;
    const auto put_bytes = [&](const char* name, std::size_t bytes) {
        put(name, bytes);
        memory += bytes;
    };
    put_bytes("query_bytes", collider_->reserved().total() + (one_tree_ ? one_tree_->bytes() : 0));
    if (builder_ != nullptr) {
        const Footprint tree = builder_->reserved();
        put_bytes("tree_bytes", tree.tree_bytes + uploaded_.reserved().total());
        put_bytes("scratch_bytes", tree.scratch_bytes);
        put("rebuilt_objects_count", updated(TreeUpdate::rebuild));
        put("refitted_objects_count", updated(TreeUpdate::refit));
        put("kept_objects_count", updated(TreeUpdate::keep));
        put("sorts_count", updated(TreeUpdate::rebuild) > 0 ? 1 : 0);
    }
    if (entering_)
        put("entered_count", entering_->input.triangle_count());
    if (near_)
        put_bytes("near_bytes", near_->reserved().total());
    if (margin_)
        put_bytes("margin_bytes", margin_->bytes() + (standing_ ? standing_->bytes() : 0));
    if (narrow_) {
        const NarrowCounts narrow = queries() ? narrow_->counts(queue) : NarrowCounts{};
        if (!is_plain())
            put("standing_count", pair_count() - tested_);
        put("contacts_count", narrow.contacts);
        put("narrow_float_count", narrow.by_floats);
        put("narrow_double_count", narrow.by_doubles);
        put("narrow_exact_count", narrow.exactly);
        if (narrow_->is_swept() && narrow.contacts > 0)
            put("earliest_impact", std::ranges::min(narrow_->impact_times(queue)));
        put_bytes("narrow_bytes",
                  narrow_->reserved().total() + (padding_ ? padding_->reserved().total() : 0));
    }
    if (within_) {
        const WithinCounts within = within_->counts(queue);
        put("contacts_count", within.within);
        put("narrow_exact_count", within.exactly);
        put_bytes("narrow_bytes", within_->reserved().total());
    }
    put("memory_bytes", memory);
    return counters;
}

}  // namespace bvhbench
