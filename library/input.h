// SPDX-License-Identifier: MIT
//
// From what a caller has to what builders take.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "builders/input.h"
#include "device/arena.h"
#include "library/device.h"

namespace bvhbench::oibvh {

/// Triangles, in device memory. A box is a triangle whose corners are two of its own, opposite ones: its box is that box,
/// and a buffer of boxes is one of points, two a box.
class InputTaker {
public:
    InputTaker(Device::Impl& device, bool check);

    /// What builders take, of objects of so many triangles or boxes each; one, of all, if there are no sizes. Copies what
    /// is on the host, and looks at all that there is if it is to be checked; waits for both. Holds until the next call.
    /// Throws BadUsage for what cannot be.
    const bvhbench::Input& take(const Input& input, std::span<const std::uint32_t> sizes);

    const bvhbench::Input& taken() const { return taken_; }

    /// Bytes of the device's that it has taken for what was copied.
    std::size_t memory() const;

private:
    /// Memory of just the size that is wanted.
    struct Room {
        std::optional<Arena> arena;
        Buffer<std::byte> memory;
    };
    /// All of it; what was there is gone if it had another size.
    template <class T>
    Buffer<T> room_for(std::size_t count, Room& room);

    template <class T, class U>
    Buffer<T> copied(std::span<const U> values, Room& room);

    template <class T>
    Buffer<T> callers(cl_mem memory, std::size_t count, std::size_t item_bytes,
                      const char* what) const;

    void take_boxes(const Buffer<bvhbench::Point>& corners);
    void take_objects(std::span<const std::uint32_t> sizes);
    void check(bool are_boxes);
    void complain(bool are_boxes) const;

    Device::Impl& device_;
    bool checks_;
    cl::Kernel triangles_kernel_, boxes_kernel_, faces_kernel_;
    std::size_t box_faces_made_ = 0;  ///< for so many boxes; 0 while that has not gone well
    Room points_, faces_, box_faces_, owners_, flag_;
    bvhbench::Input taken_;
};

}  // namespace bvhbench::oibvh
