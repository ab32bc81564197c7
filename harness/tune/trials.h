// SPDX-License-Identifier: MIT
//
// What can be tuned: the sort, a builder, a collider over a builder's trees.
#pragma once

#include <optional>
#include <string>

#include "collide/pairs.h"
#include "harness/choice/collider_catalog.h"
#include "harness/judge/check.h"
#include "harness/session/session.h"
#include "harness/tune/tuner.h"

namespace bvhbench {

/// What is tuned, and over what.
struct TuneTask {
    std::string target;  ///< "sort", that of the builder, or a builder's name or a collider's
    std::string scene;
    BuilderChoice
        builder;  ///< of a collider's trees, or with the options of the builder that is tuned
    ColliderChoice collider;  ///< with the collider's options
};

/// Throws BadUsage, with the names of all targets, if there is none called so.
void check_target(const std::string& target);

/// A target over its scene, read and uploaded once; answers are worked out once, by the references.
class TuneTarget {
public:
    /// Throws what loading a scene throws, and BadUsage for a target that nothing tunes.
    TuneTarget(Session& session, TuneTask task);
    TuneTarget(const TuneTarget&) = delete;
    TuneTarget& operator=(const TuneTarget&) = delete;

    /// One trial with such values, on the session's device. It must not outlive this.
    std::unique_ptr<Trial> trial(const Tuning& tuning);

    /// Whether a parameter is this target's own: a collider leaves builders' alone.
    bool wants(const Parameter& parameter) const;

private:
    Session& session_;
    TuneTask task_;
    Scene scene_;
    Input input_;
    Oracle oracle_{session_, input_};
    PairList pairs_;                    ///< what a query must find
    std::optional<PairList> contacts_;  ///< if it looks for any, and there is a reference
};

}  // namespace bvhbench
