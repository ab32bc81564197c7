// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "device/buffer.h"
#include "device/device.h"

namespace bvhbench {

/// Device memory in bytes, by what it is for.
struct Footprint {
    std::size_t tree_bytes = 0;     ///< stays in use as long as the tree does
    std::size_t scratch_bytes = 0;  ///< needed while building only; alignment gaps count here

    std::size_t total() const { return tree_bytes + scratch_bytes; }
    bool operator==(const Footprint&) const = default;
};

/// What a piece of an arena is for.
enum class Use { tree, scratch };

/// One allocation, handed out front to back in typed pieces: there is no second way to get device memory. Of more bytes
/// than a device allocates at once, each piece is an allocation of its own.
///
/// A builder writes down once which pieces it takes, in one function of an Arena&. Run on a measuring arena
/// that function predicts the footprint; run on a reserved one it gives the buffers. So prediction and fact
/// cannot drift apart.
class Arena {
public:
    /// Hands out empty buffers and only adds up.
    static Arena measuring(const Device& device);

    /// Exactly `footprint.total()` bytes of device memory.
    /// Throws Unavailable, before allocating, if the device cannot hold them all; a piece too large for one allocation is
    /// refused when it is taken.
    static Arena reserved(const Device& device, const Footprint& footprint);

    template <class T>
    Buffer<T> take(std::size_t size, Use use)
    {
        return {carve(size * sizeof(T), use), size};
    }

    /// Bytes handed out so far.
    const Footprint& used() const { return used_; }

private:
    Arena(const Device& device, std::size_t capacity);
    cl::Buffer carve(std::size_t bytes, Use use);

    MemoryShare share_;
    cl::Buffer memory_;             ///< null when measuring, and of pieces of their own
    std::optional<Device> pieces_;  ///< who allocates those
    std::size_t alignment_ = 1;
    std::size_t capacity_ = 0;
    Footprint used_;
};

}  // namespace bvhbench
