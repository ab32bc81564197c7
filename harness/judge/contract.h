// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "harness/judge/check.h"
#include "harness/session/session.h"

namespace bvhbench {

/// The first promise that a builder breaks over `input`, as a sentence; empty if it keeps all of them:
///
/// what it reserves is what it predicted; its tree is one (broken_promise) and, if its entry names an oracle,
/// the oracle's; a second build leaves the same tree; so does a build from sorted leaves; a refit to moved points
/// keeps the topology and makes every box right, and a build after it leaves the first tree again.
/// A builder whose entry may_refuse passes when it throws Unavailable; `refused`, if given, says whether it did.
std::string broken_contract(Session& session, const BuilderChoice& choice, const Input& input,
                            Oracle& oracle, bool* refused = nullptr);

}  // namespace bvhbench
