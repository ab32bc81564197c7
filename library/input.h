// SPDX-License-Identifier: MIT
//
// Converts the input of library calls to the input of builders.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "builders/input.h"
#include "device/arena.h"
#include "library/device.h"

namespace bvhbench::oibvh {

/// Throws BadUsage unless a tree can have `count` leaves.
void require_count(std::size_t count, const char* what);

bool is_finite(bvhbench::Point point);
std::string text_of(bvhbench::Point point);

/// Turns the caller's input into triangles in device memory. A box becomes a degenerate triangle over its minimum and maximum
/// corners; the bounding box of that triangle is the box itself. So a buffer of boxes serves as one of points, two a box.
class InputTaker {
public:
    InputTaker(Device::Impl& device, bool check);

    /// Returns the builders' input for objects of `sizes` triangles or boxes each, or for one object if `sizes` is empty.
    /// Copies host arrays, and checks all values if checking is on; both wait. The result is valid until the next call.
    /// Throws BadUsage for invalid input.
    const bvhbench::Input& take(const Input& input, std::span<const std::uint32_t> sizes);

    const bvhbench::Input& taken() const { return taken_; }
    bool are_boxes() const { return are_boxes_; }  ///< whether the input was of boxes

    /// Returns the bytes of device memory held: copies of host arrays, faces made for boxes, owners and the check's flag.
    std::size_t memory() const;

private:
    /// A buffer that is allocated at exactly the size needed.
    struct Room {
        std::optional<Arena> arena;
        Buffer<std::byte> memory;
    };
    /// Returns a buffer of `count` values in `room`. Reallocates, and loses the contents, if the size differs.
    template <class T>
    Buffer<T> room_for(std::size_t count, Room& room);

    template <class T, class U>
    Buffer<T> copied(std::span<const U> values, Room& room);

    template <class T>
    Buffer<T> callers(cl_mem memory, std::size_t count, std::size_t item_bytes,
                      const char* what) const;

    void take_boxes(const Buffer<bvhbench::Point>& corners);
    void take_objects(std::span<const std::uint32_t> sizes);
    void check();
    void complain() const;

    Device::Impl& device_;
    bool checks_, are_boxes_ = false;
    cl::Kernel triangles_kernel_, boxes_kernel_, faces_kernel_;
    std::size_t box_faces_made_ = 0;  ///< boxes that `box_faces_` holds faces for; 0 if none
    Room points_, faces_, box_faces_, owners_, flag_;
    bvhbench::Input taken_;
};

}  // namespace bvhbench::oibvh
