// SPDX-License-Identifier: MIT
//
// Exceptions for errors that a user or a machine can cause, one class for each exit code that main returns for them.
#pragma once

#include <stdexcept>

namespace bvhbench {

/// The command asked for something that does not exist or makes no sense. Exit code 2.
class BadUsage : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A device, file, library or enough memory is missing, or a file is malformed. Exit code 3.
class Unavailable : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Every measurement that was asked for was skipped or failed. Exit code 4.
class NothingMeasured : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace bvhbench
