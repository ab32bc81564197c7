// SPDX-License-Identifier: MIT
//
// The right pairs and contacts of a frame, which the host computes while the device compiles.
#pragma once

#include <chrono>
#include <future>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "collide/oracles/exact_reference.h"
#include "collide/oracles/sweep.h"
#include "geometry/host_memory.h"
#include "harness/base/terminal.h"
#include "harness/choice/catalog.h"

namespace bvhbench {

/// A list that an oracle computed.
struct Answer {
    Answer(PairList computed, std::span<const uint> file_faces)
        : list(std::move(computed)), in_file(renumbered(list, file_faces)), hash(in_file.hash())
    {}

    PairList list;
    PairList in_file;    ///< with triangles numbered as in the scene's file
    std::uint64_t hash;  ///< of in_file
};

/// Computes the pairs and contacts of a frame on another core, each when first asked for.
class FrameOracle {
public:
    /// `file_faces` are as in FrameOfPipelines. `note` receives a line of progress each second of waiting.
    FrameOracle(const Input& input, std::span<const uint> file_faces, Note note)
        : input_(input), file_faces_(file_faces), note_(std::move(note))
    {}

    /// Starts computing the pairs. Nothing may be timed before wait().
    void begin(const ColliderChoice& choice) { entry(choice); }

    /// Blocks until all pairs that were begun are computed.
    void wait() const
    {
        for (const auto& [choice, one] : entries_)
            wait_for(one.pairs);
    }

    const Answer& pairs(const ColliderChoice& choice)
    {
        return wait_for(entry(choice).pairs).get();
    }

    const Answer& contacts(const ColliderChoice& choice)
    {
        Later& found = entry(choice).contacts;
        if (!found.valid())
            found = std::async(std::launch::async, [this, keep_adjacent = choice.keep_adjacent,
                                                    of = &pairs(choice).list] {
                return Answer(
                    intersecting_pairs(input_.points, input_.faces, of->pairs(), keep_adjacent),
                    file_faces_);
            });
        return wait_for(found).get();
    }

private:
    using Later = std::shared_future<Answer>;
    struct Entry {
        Later pairs, contacts;
    };

    const Later& wait_for(const Later& later) const
    {
        for (int seconds = 1; later.wait_for(std::chrono::seconds(1)) != std::future_status::ready;
             ++seconds) {
            if (note_)
                note_("the oracle is checking, " + std::to_string(seconds) + " s", 0);
        }
        return later;
    }

    Entry& entry(const ColliderChoice& choice)
    {
        const std::pair asked(choice.among, choice.keep_adjacent);
        const auto [at, is_new] = entries_.try_emplace(asked);
        if (is_new)
            at->second.pairs = std::async(std::launch::async, [this, asked] {
                require_host_memory("checking the pairs", input_.faces.size() * sizeof(Aabb));
                return Answer(touching_pairs(leaf_boxes(input_), input_.faces, asked.second,
                                             input_.objects, asked.first),
                              file_faces_);
            });
        return at->second;
    }

    const Input& input_;
    std::span<const uint> file_faces_;
    Note note_;
    std::map<std::pair<Among, bool>, Entry>
        entries_;  ///< by the kind of pairs, and whether adjacent ones are kept
};

}  // namespace bvhbench
