// SPDX-License-Identifier: MIT
//
// Runs a pipeline over all frames of a scene, for tests of the work that it leaves out.
#pragma once

#include "harness/measure/frames.h"
#include "tests/collide/collider_testing.h"

namespace bvhbench {

using Counters = std::map<std::string, double>;

/// Runs a pipeline over the frames of a scene, compares each frame's pairs with the oracle's, and returns each frame's counters.
inline std::vector<Counters> run_frames(const Scene& scene, const BuilderChoice& builder,
                                        const ColliderChoice& collider)
{
    SCOPED_TRACE(collider.name + " over " + builder.name);
    Input input = upload_frame(session(), scene, 0);
    Pipeline pipeline(session(), builder, collider, input);
    std::vector<Counters> all;
    for (std::size_t frame = 0; frame < scene.frames.size(); ++frame) {
        go_to(scene.frames[frame], pipeline, input,
              frame == 0 ? std::vector<Motion>{} : object_motions(scene, frame - 1, frame));
        all.push_back(pipeline.counters());
        const PairList expected = touching_pairs(input.points, input.faces, collider.keep_adjacent,
                                                 input.objects, collider.among);
        EXPECT_GT(expected.size(), 0u);
        for (int sample = 0; sample < 2; ++sample) {
            pipeline.once(input);
            EXPECT_EQ(PairList(pipeline.pairs()), expected) << "frame " << frame;
            EXPECT_EQ(PairList(pipeline.pairs()).surplus(), 0u);
            EXPECT_EQ(pipeline.counters(), all.back()) << "each sample does the same work";
        }
    }
    return all;
}

/// Expects how many objects were rebuilt, refitted and kept.
inline void expect_updates(const Counters& counters, double rebuilt, double refitted, double kept)
{
    EXPECT_EQ(counters.at("rebuilt_objects_count"), rebuilt);
    EXPECT_EQ(counters.at("refitted_objects_count"), refitted);
    EXPECT_EQ(counters.at("kept_objects_count"), kept);
    EXPECT_EQ(counters.at("sorts_count"), rebuilt > 0 ? 1 : 0);
}

}  // namespace bvhbench
