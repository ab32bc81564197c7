// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "device/buffer.h"
#include "device/device.h"

namespace bvhbench {

/// Device memory in bytes, by what it is for.
struct Footprint {
    std::size_t tree_bytes = 0;     ///< in use as long as the tree
    std::size_t scratch_bytes = 0;  ///< in use only while building; includes alignment gaps

    std::size_t total() const { return tree_bytes + scratch_bytes; }
    bool operator==(const Footprint&) const = default;
};

/// What a piece of an arena is for.
enum class Use { tree, scratch };

/// One allocation of device memory, handed out front to back in typed pieces; all device memory comes from arenas. If the
/// total exceeds the largest single allocation of the device, each piece is allocated separately.
///
/// A builder lists its pieces in one function of an Arena&. On a measuring arena this function predicts the footprint; on a
/// reserved arena it returns the buffers. So the prediction always matches the memory taken.
class Arena {
public:
    /// Returns an arena that hands out empty buffers and only adds up their bytes.
    static Arena measuring(const Device& device);

    /// Returns an arena of exactly `footprint.total()` bytes of device memory. Throws Unavailable, before allocating, if the
    /// device cannot hold them. `take` throws Unavailable for a piece that is too large for one allocation.
    static Arena reserved(const Device& device, const Footprint& footprint);

    template <class T>
    Buffer<T> take(std::size_t size, Use use)
    {
        return {carve(size * sizeof(T), use), size};
    }

    /// Takes tree memory for `size` values and scratch behind it for as many, in one piece.
    template <class T>
    Buffer<T> take_twice(std::size_t size)
    {
        const Buffer<T> piece = take<T>(2 * size, Use::scratch);
        used_.scratch_bytes -= size * sizeof(T);
        used_.tree_bytes += size * sizeof(T);
        return piece;
    }

    /// Returns the bytes handed out so far.
    const Footprint& used() const { return used_; }

private:
    Arena(const Device& device, std::size_t capacity);
    cl::Buffer carve(std::size_t bytes, Use use);

    MemoryShare share_;
    cl::Buffer memory_;             ///< null if measuring, or if pieces are allocated separately
    std::optional<Device> pieces_;  ///< set if pieces are allocated separately, on this device
    std::size_t alignment_ = 1;
    std::size_t capacity_ = 0;
    Footprint used_;
};

}  // namespace bvhbench
