// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <string>

namespace bvhbench {

/// Returns the error as one sentence. The sentence for an OpenCL error names the call and the error code.
std::string sentence_of(const std::exception& error);

/// Throws Unavailable, which says that the file cannot be written, and `why`; by default, what the last failed call left in errno.
[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& why = {});

/// Runs `work`. Returns an empty string on success, else the reason of the failure as one sentence.
///
/// Used for single cells of a run, whose failure is recorded as a result. On failure, `cannot_be` is set to whether `work` threw
/// BadUsage: in a cell, that means that the builder does not support an option for this scene, not a wrong command line.
std::string reason_of_failure(const std::function<void()>& work, bool* cannot_be = nullptr);

}  // namespace bvhbench
