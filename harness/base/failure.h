// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <functional>
#include <string>

namespace bvhbench {

/// What went wrong, as one sentence; for an OpenCL error with the call and the error's name.
std::string sentence_of(const std::exception& error);

/// Run `work`. If it fails, the sentence why; empty when it went well.
///
/// For one cell of many, whose failure is a result.
std::string reason_of_failure(const std::function<void()>& work);

/// The same. `cannot_be` is set to whether it was a BadUsage: an option that this builder does not have over this scene is
/// wrong usage of the cell, not of the program.
std::string reason_of_failure(bool& cannot_be, const std::function<void()>& work);

}  // namespace bvhbench
