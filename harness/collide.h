// SPDX-License-Identifier: MIT
#pragma once

#include "collide/pairs.h"
#include "harness/options.h"
#include "harness/record.h"
#include "harness/session.h"

namespace bvhbench {

/// One collider over one builder's tree of one scene: checked against the oracle, then sampled, each sample a whole
/// build and a whole query. A sample that finds other pairs than the oracle makes the verdict.
///
/// `pairs` becomes the list found last. Throws what loading, building and querying throw.
Cell collide_scene(Session& session, const CollideCommand& command, PairList& pairs);

}  // namespace bvhbench
