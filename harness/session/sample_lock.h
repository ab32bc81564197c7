// SPDX-License-Identifier: MIT
#pragma once

namespace bvhbench {

/// While it exists, no other run of the machine takes samples that names the same file in BVHBENCH_SAMPLE_LOCK. Their preparation
/// and their checks may run beside the samples. The system frees the lock of a process that ends. Does nothing without the variable.
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
