// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "harness/choice/catalog.h"
#include "harness/session/session.h"
#include "scenes/motion.h"

namespace bvhbench {

/// The frames of a scene of several objects as those of one object, for a pipeline with `trees: scene`.
///
/// One tree finds the pairs within objects too. If only those between objects are wanted, the collider is asked to drop pairs
/// that share a vertex index, and gets faces whose three corners are the number of the triangle's object. Builder and narrow phase
/// get the true faces.
class OneTree {
public:
    /// Copies the faces of the query to the device. Throws BadUsage if the input is swept, if pairs within objects, a filter or the first contact
    /// between objects are wanted, or if objects share a vertex and pairs that share one are to be dropped between objects.
    OneTree(Session& session, const ColliderChoice& asked, const Input& input);

    /// What the collider is asked for, in place of what the pipeline is.
    const ColliderChoice& question() const { return question_; }

    /// What the builder gets of a frame, and what the collider gets. Valid until the next call, while `frame` is.
    const Input& built(const Input& frame) { return at(built_, frame); }
    const Input& queried(const Input& frame)
    {
        return at(owners_.empty() ? built_ : queried_, frame);
    }

    /// Device memory that this object has taken.
    std::size_t bytes() const { return owners_.size() * sizeof(Face); }

private:
    static const Input& at(Input& input, const Input& frame)
    {
        input.points = frame.points;
        input.device_points = frame.device_points;
        input.end_points = frame.end_points;
        input.device_end_points = frame.device_end_points;
        return input;
    }

    ColliderChoice question_;
    /// The number of each triangle's object, three times; empty if all pairs are wanted.
    std::vector<Face> owners_;
    Input built_, queried_;
};

/// Returns what `auto` chooses for a frame: one tree over the scene if its objects are many and small and one tree can find the pairs
/// that are asked for, else a tree for each object.
TreeOver trees_over(const ColliderChoice& asked, const Input& input, bool on_cpu);

/// Returns one tree if `asked` names it, else none. Throws BadUsage as the constructor does, and for a scene of one object.
std::optional<OneTree> one_tree_for(Session& session, const ColliderChoice& asked,
                                    const Input& input);

/// Returns the motion of all objects as one: rigid motions may differ, so it is deforming unless nothing has moved.
Motion motion_of_all(std::span<const Motion> motions);

}  // namespace bvhbench
