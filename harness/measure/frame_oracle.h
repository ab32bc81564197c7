// SPDX-License-Identifier: MIT
//
// The right pairs and contacts of a frame. The host computes them while the device compiles, or an earlier run has.
#pragma once

#include <unistd.h>

#include <chrono>
#include <future>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "collide/oracles/box_pairs.h"
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/swept_reference.h"
#include "collide/oracles/touching.h"
#include "collide/within/padding.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "geometry/host_memory.h"
#include "harness/base/terminal.h"
#include "harness/base/test_hooks.h"
#include "harness/choice/catalog.h"
#include "harness/judge/kept_answers.h"
#include "process/watchdog.h"

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
    PairList uncertain = {};  ///< pairs of which it is not known whether they are of the list
    AnswerFacts facts;

private:
    std::optional<PairList> renumbered_;  ///< if the numbers differ
};

/// How far an oracle is.
struct OracleProgress {
    Checked done;
    std::atomic<std::size_t> total = 0;  ///< candidates; 0: unknown
};

/// Pairs or contacts of a frame: what identifies them, and the list, which is computed only where it is needed.
class Expected {
public:
    Expected() = default;

    /// Starts looking for a kept answer to `key`, and computing the list if there is none. `compute` is given what counts how
    /// much is done, and returns an Answer. `what` is "pairs" or "contacts".
    template <class Compute>
    Expected(std::uint64_t key, const std::string& what, Note note, Compute compute)
        : oracle_("the oracle of " + what)
        , name_("oracle " + hex(key))
        , list_(std::async(std::launch::deferred,
                           [key, why = watchdog::given_up(name_), oracle = oracle_,
                            progress = progress_, compute = std::move(compute)] {
                               if (!why.empty())
                                   throw Unavailable(oracle + ' ' + why);
                               Answer answer = compute(*progress);
                               keep_answer(key, answer.facts);
                               return answer;
                           }))
        , facts_(std::async(std::launch::async,
                            [key, list = list_] {
                                const std::optional<AnswerFacts> kept = kept_answer(key);
                                return kept ? *kept : list.get().facts;
                            }))
        , note_(std::move(note))
    {}

    bool is_asked() const { return facts_.valid(); }

    /// Blocks until facts() are there, or until it is known that there can be none. If that takes longer than the time limit, an
    /// oracle is given up, as it is if it crashes: facts() and list() of the next process throw Unavailable.
    void wait() const { wait_for(facts_); }

    /// Facts of the list, kept or computed. Blocks. Throws Unavailable if the host lacks the memory to list the pairs.
    const AnswerFacts& facts() const
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
        const watchdog::CellScope scope(name_);
        const watchdog::Watch watch;
        for (int seconds = 1; later.wait_for(std::chrono::seconds(1)) != std::future_status::ready;
             ++seconds) {
            const std::string text =
                so_far(oracle_, seconds, progress_->done.all, progress_->total);
            if (note_)
                note_(text, 0);
            if (seconds == 10 && terminal_width(STDERR_FILENO) == 0)
                std::cerr << "bvhbench: " + text + '\n' << std::flush;
        }
    }

    std::string oracle_, name_;  ///< for people, and for the watchdog
    std::shared_ptr<OracleProgress> progress_ = std::make_shared<OracleProgress>();
    std::shared_future<Answer> list_;  ///< deferred: the first who needs it computes it
    std::shared_future<AnswerFacts> facts_;
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
        content_.values(input.wide.points);
        content_.values(input.wide.end_points);
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

    const Expected& pairs(const ColliderChoice& choice)
    {
        Expected& pairs = entries_[key_of(choice, 0)].pairs;
        if (!pairs.is_asked())
            pairs = Expected(key_of(choice, 'p'), "pairs", note_, [this, choice](OracleProgress&) {
                require_host_memory("checking the pairs", input_.faces.size() * sizeof(Aabb));
                std::vector<Aabb> boxes = leaf_boxes(input_);
                if (choice.distance)
                    pad_boxes(boxes, distance_of_floats(input_, *choice.distance));
                return Answer(touching_pairs(boxes, input_.faces, choice.keep_adjacent,
                                             input_.objects, choice.among, choice.filter),
                              file_faces_);
            });
        return pairs;
    }

    const Expected& contacts(const ColliderChoice& choice)
    {
        const std::shared_future<Answer> pairs = this->pairs(choice).later();
        Expected& contacts = entries_[key_of(choice, 0)].contacts;
        if (!contacts.is_asked())
            contacts = Expected(
                key_of(choice, 'c'), "contacts", note_, [=, this](OracleProgress& progress) {
                    stop_thread_at("contacts");
                    const std::span<const Pair> candidates = pairs.get().list.pairs();
                    progress.total = candidates.size();
                    const auto touching = [&](auto points, auto end_points) {
                        const auto found =
                            touching_on_the_way(points, end_points, input_.faces, candidates,
                                                &progress.done, choice.distance.value_or(0));
                        Answer answer(pairs_of(found), file_faces_);
                        answer.uncertain = pairs_of(found, false);
                        return answer;
                    };
                    if (input_.is_wide())
                        return touching(input_.wide.points, input_.wide.end_points);
                    if (input_.is_swept())
                        return touching(input_.points, input_.end_points);
                    if (choice.distance)
                        return Answer(
                            pairs_within(input_.points, input_.faces, candidates,
                                         choice.keep_adjacent, *choice.distance, &progress.done),
                            file_faces_);
                    Answer answer(intersecting_pairs(input_.points, input_.faces, candidates,
                                                     choice.keep_adjacent, &progress.done),
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

    struct Entry {
        Expected pairs, contacts;
    };

    std::uint64_t key_of(const ColliderChoice& choice, char list) const
    {
        Hash key = content_;
        key.value(static_cast<int>(choice.among));
        key.value(choice.keep_adjacent);
        if (const std::uint64_t filter = choice.filter.hash(); filter != 0)
            key.value(filter);
        if (choice.distance)
            key.value(*choice.distance);
        key.value(list);
        return key.get();
    }

    const Input& input_;
    std::span<const uint> file_faces_;
    Note note_;
    Hash content_;                            ///< of the frame
    std::map<std::uint64_t, Entry> entries_;  ///< by what is asked
};

}  // namespace bvhbench
