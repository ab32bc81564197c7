// SPDX-License-Identifier: MIT
//
// Replaces the OpenCL loader's functions: counts calls, tracks objects, and makes a chosen call fail. It is linked into a test
// in front of the loader, or preloaded into the program as a library, where BVHBENCH_FAIL_CALL selects the failing call and
// BVHBENCH_BAD_CLOCK a clock that lies (see opencl_shim.cpp). It does not depend on the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace bvhbench::shim {

/// Selects the calls that fail: the n-th, counted from 1, or all from the n-th on, as with a lost device.
struct Plan {
    long nth = 0;  ///< 0: no call fails
    bool from_there_on = false;
};

/// Resets all counts and forgets all objects.
void begin(Plan plan);

/// Returns the number of calls since begin().
long calls();

/// Returns the name and error code of the first call that was made to fail; empty if none was.
std::string failed_call();

/// Switches the recording of calls on or off, from the next begin() on.
void remember_calls(bool wanted);

/// Returns the numbers of recorded calls after the first `behind` ones that are to fail: the first call of every `share`-th call
/// path not in `tried`, or with BVHBENCH_FAULTS=calls every call of each such path. Adds the paths to `tried`.
std::vector<long> chosen_calls(std::set<std::uint64_t>& tried, long behind, std::size_t share);
bool every_call_fails();

/// Returns, by the call that made them, the objects that were released less often than made and retained.
std::vector<std::string> leaked();

/// Returns the calls that used an object that did not exist, such as "clReleaseEvent of what is not there".
const std::vector<std::string>& misused();

}  // namespace bvhbench::shim
