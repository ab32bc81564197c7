// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "harness/session/session.h"

namespace bvhbench {

/// Prints the device with its limits, and a line for each builder, collider and narrow phase over the scenes of `smoke`: held to
/// the oracles once and not timed. What a user of a device that nobody has tried runs and sends. Returns the exit code; throws
/// NothingMeasured.
int check_portable(Session& session, std::vector<std::string> command);

}  // namespace bvhbench
