// SPDX-License-Identifier: MIT
//
// Stands between a program and the OpenCL loader: counts calls, keeps account of objects, and lets a call fail on demand.
// Linked into a test it takes the loader's place; as a library it is preloaded into the program, and BVHBENCH_FAIL_CALL
// says which call fails (see opencl_shim.cpp). Knows nothing of what it stands before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace bvhbench::shim {

/// Which calls fail: the n-th, counted from 1, or all from there on, as of a device that is gone.
struct Plan {
    long nth = 0;  ///< 0: none
    bool from_there_on = false;
};

/// Begin to count anew, with no object on the account.
void begin(Plan plan);

/// How many calls there were since.
long calls();

/// The name of the first one that was made to fail, and the error it gave; empty if none was.
std::string failed_call();

/// Whether calls are remembered from the next `begin` on.
void remember_calls(bool wanted);

/// Numbers of the remembered calls behind the first ones that are to fail: of every `share`-th way that is not among `tried`
/// the first call, or with BVHBENCH_FAULTS=calls every call of such a way. Adds the ways to `tried`.
std::vector<long> chosen_calls(std::set<std::uint64_t>& tried, long behind, std::size_t share);
bool every_call_fails();

/// Objects that were made and are not released as often as they were made and retained, by the call that made them.
std::vector<std::string> leaked();

/// Calls that used an object which was no longer there, or was never: "clReleaseEvent of what is not there".
const std::vector<std::string>& misused();

}  // namespace bvhbench::shim
