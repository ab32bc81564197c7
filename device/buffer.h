// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "device/cl.h"

namespace bvhbench {

/// Device memory that holds `size()` values of T: an OpenCL buffer of its own or a piece of an Arena.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>, "device memory holds plain bytes");

public:
    Buffer() = default;
    Buffer(cl::Buffer memory, std::size_t size) : memory_(std::move(memory)), size_(size) {}
    Buffer(const Buffer&) = default;
    Buffer(Buffer&&) = default;
    /// Copies first and then moves: if retaining fails inside the bindings' copy assignment, the target keeps a handle that it
    /// never retained and later releases.
    Buffer& operator=(Buffer other)
    {
        memory_ = std::move(other.memory_);
        size_ = other.size_;
        return *this;
    }
    ~Buffer() = default;

    std::size_t size() const { return size_; }
    std::size_t bytes() const { return size_ * sizeof(T); }
    const cl::Buffer& cl() const { return memory_; }

    /// Returns the same memory viewed as values of U.
    template <class U>
    Buffer<U> as() const
    {
        assert(bytes() % sizeof(U) == 0);
        return {memory_, bytes() / sizeof(U)};
    }

    /// Writes `values` to the front. Waits.
    void upload(const cl::CommandQueue& queue, std::span<const T> values)
    {
        assert(values.size() <= size_);
        if (!values.empty())
            queue.enqueueWriteBuffer(memory_, CL_TRUE, 0, values.size_bytes(), values.data());
    }

    /// Returns a copy of all values, after everything enqueued before has run. Waits.
    std::vector<T> download(const cl::CommandQueue& queue) const
    {
        std::vector<T> values(size_);
        if (size_ > 0)
            queue.enqueueReadBuffer(memory_, CL_TRUE, 0, bytes(), values.data());
        return values;
    }

private:
    cl::Buffer memory_;
    std::size_t size_ = 0;
};

/// Maps a buffer into host memory for the lifetime of the object. Nothing is copied if device and host share memory.
template <class T>
class Mapped {
public:
    /// Maps the buffer once everything enqueued before has run. Waits. `flags` are CL_MAP_READ, CL_MAP_WRITE or both. For an
    /// empty buffer `data()` is null.
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
        if (data_ != nullptr)  // the bindings' function would throw
            clEnqueueUnmapMemObject(queue_(), memory_(), data_, 0, nullptr, nullptr);
    }

    T* data() const { return data_; }

private:
    cl::CommandQueue queue_;
    cl::Buffer memory_;
    T* data_ = nullptr;
};

/// Returns the kernel argument for a value: the cl::Buffer of a Buffer, any other value unchanged.
template <class T>
const cl::Buffer& memory_of(const Buffer<T>& buffer)
{
    return buffer.cl();
}
template <class T>
const T& memory_of(const T& value)
{
    return value;
}

/// Sets all arguments of a kernel, in order.
template <class... Arguments>
cl::Kernel& set_arguments(cl::Kernel& kernel, const Arguments&... arguments)
{
    cl_uint index = 0;
    (kernel.setArg(index++, memory_of(arguments)), ...);
    return kernel;
}

}  // namespace bvhbench
