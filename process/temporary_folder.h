// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "process/interrupt.h"

namespace bvhbench {

/// A new folder among temporary files. The destructor removes it with all that is in it, and so does a signal that ends the program.
class TemporaryFolder {
public:
    /// `of` is part of its name. Throws Unavailable if it cannot be made.
    explicit TemporaryFolder(const std::string& of);
    ~TemporaryFolder();

    const std::filesystem::path path;

private:
    AtSignal removed_;
};

}  // namespace bvhbench
