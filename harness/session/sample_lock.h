// SPDX-License-Identifier: MIT
#pragma once

namespace bvhbench {

/// Locks the file that BVHBENCH_SAMPLE_LOCK names. Other runs of the machine that name the same file wait before they take samples;
/// they may prepare and check cells meanwhile. The system frees the lock of a process that ends. Does nothing without the variable.
class SampleLock {
public:
    /// Waits until the lock is free. Throws Unavailable if the file cannot be written.
    SampleLock();
    ~SampleLock();
    SampleLock(const SampleLock&) = delete;
    SampleLock& operator=(const SampleLock&) = delete;

private:
    int descriptor_ = -1;
};

}  // namespace bvhbench
