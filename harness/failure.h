// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <functional>
#include <string>

namespace bvhbench {

/// What went wrong, as one sentence; for an OpenCL error with the call and the error's name.
std::string sentence_of(const std::exception& error);

/// Run `work`. If the machine or a builder fails in it, the sentence why; empty when it went well.
///
/// For one cell of many, whose failure is a result. BadUsage and Interrupted end the run and pass through.
std::string reason_of_failure(const std::function<void()>& work);

}  // namespace bvhbench
