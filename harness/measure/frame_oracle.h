// SPDX-License-Identifier: MIT
//
// The right pairs and contacts of a frame. The host computes them while the device compiles, or an earlier run has.
#pragma once

#include <chrono>
#include <future>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "collide/oracles/box_pairs.h"
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/swept_reference.h"
#include "collide/oracles/touching.h"
#include "geometry/hash.h"
#include "geometry/host_memory.h"
#include "harness/base/terminal.h"
#include "harness/choice/catalog.h"
#include "harness/judge/kept_answers.h"

namespace bvhbench {

/// A list that an oracle computed.
class Answer {
public:
    Answer(PairList computed, std::span<const uint> file_faces) : list(std::move(computed))
    {
        if (!file_faces.empty())
            renumbered_ = renumbered(list, file_faces);
        facts = {.set = facts_of(list.pairs()), .file_hash = in_file().hash()};
    }

    /// The list with triangles numbered as in the scene's file.
    const PairList& in_file() const { return renumbered_ ? *renumbered_ : list; }

    PairList list;
    RightFacts facts;

private:
    std::optional<PairList> renumbered_;  ///< if the numbers differ
};

/// Pairs or contacts of a frame: what identifies them, and the list, which is computed only where it is needed.
class Right {
public:
    Right() = default;

    /// Starts looking for a kept answer to `key`, and computing the list if there is none. `compute` returns an Answer.
    template <class Compute>
    Right(std::uint64_t key, Note note, Compute compute)
        : list_(std::async(std::launch::deferred,
                           [key, compute = std::move(compute)] {
                               Answer answer = compute();
                               keep_answer(key, answer.facts);
                               return answer;
                           }))
        , facts_(std::async(std::launch::async,
                            [key, list = list_] {
                                const std::optional<RightFacts> kept = kept_answer(key);
                                return kept ? *kept : list.get().facts;
                            }))
        , note_(std::move(note))
    {}

    bool is_asked() const { return facts_.valid(); }

    /// Blocks until facts() are there, or until it is known that there can be none.
    void wait() const { wait_for(facts_); }

    /// Facts of the list, kept or computed. Blocks. Throws Unavailable if the host lacks the memory to list the pairs.
    const RightFacts& facts() const
    {
        wait();
        return facts_.get();
    }

    /// The list itself. Computes it, and keeps its facts, if they were kept before. Blocks.
    const Answer& list() const
    {
        wait_for(std::async(std::launch::async, [list = list_] { list.wait(); }));
        return list_.get();
    }

    /// As list(), for whoever waits without notes.
    std::shared_future<Answer> later() const { return list_; }

private:
    template <class Later>
    void wait_for(const Later& later) const
    {
        for (int seconds = 1; later.wait_for(std::chrono::seconds(1)) != std::future_status::ready;
             ++seconds)
            if (note_)
                note_("the oracle is checking, " + std::to_string(seconds) + " s", 0);
    }

    std::shared_future<Answer> list_;  ///< deferred: the first who needs it computes it
    std::shared_future<RightFacts> facts_;
    Note note_;
};

/// Computes the pairs and contacts of a frame on other cores, each when first asked for.
class FrameOracle {
public:
    /// `file_faces` are as in FrameOfPipelines. `note` receives a line of progress each second of waiting.
    FrameOracle(const Input& input, std::span<const uint> file_faces, Note note)
        : input_(input), file_faces_(file_faces), note_(std::move(note))
    {
        content_.value(oracle_version);
        content_.values(input.points);
        content_.values(input.end_points);
        content_.values(input.faces);
        content_.values(std::span<const FaceRange>(input.objects));
        content_.values(file_faces);
    }

    /// Starts on the pairs. Nothing may be timed before wait().
    void begin(const ColliderChoice& choice) { pairs(choice); }

    /// Blocks until all pairs that were begun are computed.
    void wait() const
    {
        for (const auto& [choice, one] : entries_)
            one.pairs.wait();
    }

    const Right& pairs(const ColliderChoice& choice)
    {
        const std::pair asked(choice.among, choice.keep_adjacent);
        Right& pairs = entries_[asked].pairs;
        if (!pairs.is_asked())
            pairs = Right(key_of(asked, 'p'), note_, [this, asked] {
                require_host_memory("checking the pairs", input_.faces.size() * sizeof(Aabb));
                return Answer(touching_pairs(leaf_boxes(input_), input_.faces, asked.second,
                                             input_.objects, asked.first),
                              file_faces_);
            });
        return pairs;
    }

    const Right& contacts(const ColliderChoice& choice)
    {
        const std::shared_future<Answer> pairs = this->pairs(choice).later();
        const std::pair asked(choice.among, choice.keep_adjacent);
        Right& contacts = entries_[asked].contacts;
        if (!contacts.is_asked())
            contacts = Right(key_of(asked, 'c'), note_, [this, asked, pairs] {
                const std::span<const Pair> candidates = pairs.get().list.pairs();
                if (input_.is_swept())
                    return Answer(pairs_of(touching_on_the_way(input_.points, input_.end_points,
                                                               input_.faces, candidates)),
                                  file_faces_);
                Answer answer(
                    intersecting_pairs(input_.points, input_.faces, candidates, asked.second),
                    file_faces_);
                answer.facts.touching =
                    only_touching(input_.points, input_.faces, answer.list.pairs());
                return answer;
            });
        return contacts;
    }

private:
    /// Changes whenever an oracle answers differently, so that older answers are not found.
    static constexpr int oracle_version = 1;

    using Asked =
        std::pair<Among, bool>;  ///< the kind of pairs, and whether adjacent ones are kept
    struct Entry {
        Right pairs, contacts;
    };

    std::uint64_t key_of(const Asked& asked, char list) const
    {
        Hash key = content_;
        key.value(static_cast<int>(asked.first));
        key.value(asked.second);
        key.value(list);
        return key.get();
    }

    const Input& input_;
    std::span<const uint> file_faces_;
    Note note_;
    Hash content_;  ///< of the frame
    std::map<Asked, Entry> entries_;
};

}  // namespace bvhbench
