// SPDX-License-Identifier: MIT
//
// Decides in a race, by the cells of a scene that were measured so far, which others need not be run: those that cannot win, or are
// too far behind to win over all frames (docs/races.md).
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "harness/choice/sampling.h"
#include "harness/measure/pipeline.h"
#include "harness/record/record.h"

namespace bvhbench {

/// Returns the bytes that the builder, collider and narrow phase of a measured cell hold.
double bytes_held(const Cell& cell);

class Contest {
public:
    /// Without a race, no cell is ever left out. `has_later_frames`: over the same triangles.
    explicit Contest(Race race = Race::none, bool has_later_frames = false)
        : race_(race), has_later_frames_(has_later_frames)
    {}

    /// False if a collider starts in later frames from a tree or front that it keeps: its first frame tells nothing of them. It is
    /// never left out.
    bool can_judge(const ColliderChoice& collider) const;

    enum class Place {
        in_the_race,
        slow_once,  ///< its samples are far behind the best so far, the run before them is not
        far_behind  ///< it need not be sampled further
    };

    /// Adds a cell to the comparison and returns its place. Cells without a sample, and wrong ones, are ignored and stay in the race.
    ///
    ///     cell      with its samples so far
    ///     before    stages of the run before them; empty: unknown
    ///     slower    drift: the time of the best cell now, divided by its earlier time
    Place compare(const Cell& cell, const std::vector<StageTime>& before = {}, double slower = 1);

    /// Returns why a cell that was not run yet cannot win: the stages that it has in common with cells that were run take longer
    /// than `hopeless` times the best of those. Empty if it may win, and always in a race for memory.
    ///
    /// Equal trees are built from equal leaves and queried alike. So the stages before `hierarchy` are known from any builder of
    /// the same tree with the same options, `hierarchy` from the same builder along any order, and `broad` from the same
    /// collider over the same tree. Over the same kind of tree along another order, `broad` counts a third of the least known time.
    /// An unknown stage counts as 0.
    std::string why_not(const Cell& cell) const;

    /// In a race, writes the counters sah_inner and sah_leaf of the tree that a pipeline queried, if it is of one object.
    void count_areas(const Pipeline& pipeline, const Input& input, Cell& cell) const;

    /// Takes all cells of a frame, in the same order for each frame, after they were sampled. What is known of stages and of the
    /// best ends with the frame.
    void end_frame(std::span<const Cell> cells);

    /// Returns why the cell number `k` need not be measured in later frames: over the frames so far it takes more than `lost`
    /// times as long as the best, or as much memory. Empty if it should be.
    std::string why_lost(std::size_t k) const;

private:
    static constexpr double hopeless = 1.5;
    static constexpr double lost = 2;

    /// By how much orders change the time of `broad`: in all files of results/ two orders of one kind of tree differ by at most a
    /// factor of 3.4, and by 2.5 without `front`; `hopeless` is on top of it.
    static constexpr double across_orders = 3;

    void keep_least(const std::string& key, double ns);
    double least_of(const std::string& key) const;  ///< 0 if unknown
    double value_of(const Cell& cell) const;        ///< what the race is for, of a measured cell

    Race race_;
    bool has_later_frames_;
    std::map<std::string, double> least_;  ///< nanoseconds of each stage under its key
    double best_ns_ = 0;                   ///< of the first samples; 0: none yet
    /// Of each cell over the frames; NaN if one is missing or tells nothing.
    std::vector<double> sums_;
};

}  // namespace bvhbench
