// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "device/buffer.h"

namespace bvhbench {

/// A buffer as the host sees it, from the end of what was enqueued before until this goes away. Nothing is copied
/// where device and host share memory. Waits.
template <class T>
class Mapped {
public:
    /// `flags`: CL_MAP_READ, CL_MAP_WRITE or both. An empty buffer is mapped to nothing.
    Mapped(const cl::CommandQueue& queue, const Buffer<T>& buffer, cl_map_flags flags)
        : queue_(queue), memory_(buffer.cl())
    {
        if (buffer.size() > 0)
            data_ = static_cast<T*>(
                queue_.enqueueMapBuffer(memory_, CL_TRUE, flags, 0, buffer.bytes()));
    }
    Mapped(const Mapped&) = delete;
    Mapped& operator=(const Mapped&) = delete;
    ~Mapped()
    {
        if (data_ != nullptr)  // the bindings' own would throw
            clEnqueueUnmapMemObject(queue_(), memory_(), data_, 0, nullptr, nullptr);
    }

    T* data() const { return data_; }

private:
    cl::CommandQueue queue_;
    cl::Buffer memory_;
    T* data_ = nullptr;
};

}  // namespace bvhbench
