// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <functional>
#include <string>

namespace bvhbench {

/// Returns the error as one sentence. The sentence for an OpenCL error names the call and the error code.
std::string sentence_of(const std::exception& error);

/// Runs `work`. Returns an empty string on success, else the reason of the failure as one sentence.
///
/// Used for single cells of a run, whose failure is recorded as a result.
std::string reason_of_failure(const std::function<void()>& work);

/// The same. Also sets `cannot_be`: true if `work` threw BadUsage. In a cell, BadUsage means that the builder does not
/// support an option for this scene; it does not mean that the command line was wrong.
std::string reason_of_failure(bool& cannot_be, const std::function<void()>& work);

}  // namespace bvhbench
