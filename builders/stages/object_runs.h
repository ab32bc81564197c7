// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "builders/stages/kernel_form.h"
#include "device/arena.h"
#include "device/queue.h"

namespace bvhbench {

/// Neighbouring triangles of one object, which a group or a work-item takes. 16 bytes, a uint4 on the device.
struct ObjectRun {
    uint first = 0, end = 0;
    uint object = 0;
    /// Triangles before them whose leaves keep their order: so much lower is their place among those whose do not.
    uint standing = 0;
};
static_assert(sizeof(ObjectRun) == 16);

/// Which objects a pass over triangles is about, cut into runs: all, or some. Those that are lined up come first.
class ObjectRuns {
public:
    static constexpr uint usual_group_size = 256;
    static constexpr uint rounds = 4;  ///< of a group's size each, that a group takes at most

    ObjectRuns(const Device& device, KernelForm form, uint group_size = usual_group_size);

    /// Take room for any of the objects of so many triangles each, none of them empty.
    void plan(Arena& arena, std::span<const uint> sizes);

    /// Those `lined_up` anew, and `others`; both ascending. Waits.
    void choose(const cl::CommandQueue& queue, std::span<const uint> lined_up,
                std::span<const uint> others = {});

    /// All of them, lined up anew. Waits.
    void choose_all(const cl::CommandQueue& queue);

    /// Work-items for each run.
    std::size_t group() const { return form_ == KernelForm::groups ? group_size_ : 1; }
    uint group_size() const { return group_size_; }  ///< whatever the form

    std::size_t count() const { return count_; }
    std::size_t lined_up_count() const { return lined_up_count_; }      ///< runs of those lined up
    std::size_t lined_up_objects() const { return lined_up_objects_; }  ///< how many of those
    uint triangles() const { return triangles_; }
    uint lined_up_triangles() const { return lined_up_triangles_; }

    const Buffer<ObjectRun>& runs() const { return runs_; }
    /// Of each chosen object, and the end.
    const Buffer<uint>& first_runs() const { return first_runs_; }
    const Buffer<uint>& objects() const { return objects_; }  ///< the chosen ones

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
