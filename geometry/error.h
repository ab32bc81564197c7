// SPDX-License-Identifier: MIT
//
// What a user or a machine can cause, by the exit code it ends in. main is the only place that catches.
#pragma once

#include <stdexcept>

namespace bvhbench {

/// The command asked for something that does not exist or makes no sense. Exit code 2.
class BadUsage : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A device, file, library or enough memory is not there, or a file is not what it should be. Exit code 3.
class Unavailable : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// All that was to be measured was skipped or failed. Exit code 4.
class NothingMeasured : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace bvhbench
