// SPDX-License-Identifier: MIT
//
// Targets of tuning: the sort, a builder, or a collider over a builder's trees.
#pragma once

#include <optional>
#include <string>

#include "collide/pairs.h"
#include "harness/choice/catalog.h"
#include "harness/judge/check.h"
#include "harness/session/session.h"
#include "harness/tune/tuner.h"

namespace bvhbench {

/// What is tuned, and the scene it is tuned over.
struct TuneTask {
    std::string target;  ///< "sort" (the builder's sort stage), or a builder's or collider's name
    std::string scene;
    /// Builder of a collider's trees, or options of the tuned builder.
    BuilderChoice builder;
    ColliderChoice collider;  ///< options of the tuned collider
};

/// Throws BadUsage, with the names of all targets, if `target` is not one.
void check_target(const std::string& target);

/// A target over its scene, which is read and uploaded once. The correct answers are computed once, by the references.
class TuneTarget {
public:
    /// Throws what loading a scene throws, and BadUsage for an unknown target.
    TuneTarget(Session& session, TuneTask task);
    TuneTarget(const TuneTarget&) = delete;
    TuneTarget& operator=(const TuneTarget&) = delete;

    /// Returns a trial with these values on the session's device. It must not outlive this object.
    std::unique_ptr<Trial> trial(const Tuning& tuning);

    /// True if the parameter belongs to this target: tuning a collider does not change the builder's parameters.
    bool wants(const Parameter& parameter) const;

private:
    Session& session_;
    TuneTask task_;
    Scene scene_;
    Input input_;
    Oracle oracle_{session_, input_};
    PairList pairs_;                    ///< correct pairs of a collider
    std::optional<PairList> contacts_;  ///< its correct contacts, if it has any and a reference
};

}  // namespace bvhbench
