// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "builders/stages/kernel_form.h"
#include "device/arena.h"
#include "device/queue.h"

namespace bvhbench {

/// A run of neighbouring triangles of one object, processed by one group or work-item. 16 bytes, a uint4 on the device.
struct ObjectRun {
    uint first = 0, end = 0;
    uint object = 0;
    /// Triangles before this run in mesh order that are not reordered: the run's codes and sorted ids are stored that much
    /// earlier. 0 in runs that are not reordered.
    uint standing = 0;
};
static_assert(sizeof(ObjectRun) == 16);

/// The objects that a pass over triangles processes (all or some), cut into runs. Runs of reordered objects come first.
class ObjectRuns {
public:
    static constexpr uint usual_group_size = 256;
    static constexpr uint rounds = 4;  ///< A run has at most rounds * group_size triangles.

    ObjectRuns(const Device& device, KernelForm form, uint group_size = usual_group_size);

    /// Takes memory for any subset of objects of `sizes` triangles, each at least 1.
    void plan(Arena& arena, std::span<const uint> sizes);

    /// Chooses the objects `lined_up`, which are reordered, and `others`; both ascending. Blocks.
    void choose(const cl::CommandQueue& queue, std::span<const uint> lined_up,
                std::span<const uint> others = {});

    /// Chooses all objects as reordered. Blocks.
    void choose_all(const cl::CommandQueue& queue);

    /// Returns the work-items per run.
    std::size_t group() const { return form_ == KernelForm::groups ? group_size_ : 1; }
    uint group_size() const { return group_size_; }  ///< Independent of the kernel form.

    std::size_t count() const { return count_; }
    std::size_t lined_up_count() const { return lined_up_count_; }      ///< Reordered runs.
    std::size_t lined_up_objects() const { return lined_up_objects_; }  ///< Reordered objects.
    uint triangles() const { return triangles_; }
    uint lined_up_triangles() const { return lined_up_triangles_; }

    const Buffer<ObjectRun>& runs() const { return runs_; }
    /// First run of each chosen object, then the number of runs.
    const Buffer<uint>& first_runs() const { return first_runs_; }
    const Buffer<uint>& objects() const { return objects_; }  ///< The chosen objects.

private:
    KernelForm form_;
    uint group_size_;
    std::size_t chunks_;
    std::vector<uint> sizes_;
    std::size_t count_ = 0, lined_up_count_ = 0, lined_up_objects_ = 0;
    uint triangles_ = 0, lined_up_triangles_ = 0;
    Buffer<ObjectRun> runs_;
    Buffer<uint> first_runs_, objects_;
};

}  // namespace bvhbench
