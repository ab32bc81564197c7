// SPDX-License-Identifier: MIT
//
// Contacts of what rests stand, in frames under the rule `margin` (collide/margin/margin.h). A pair stands if the corners of both of
// its triangles have the bits that they had in the frame before. A pair that stands is not given to the narrow phase; of the contacts
// of the frame before, those that stand are appended to the contacts found.
//
// Proof. A verdict of the narrow phase depends on the bits of six corners and on six indices. So a pair that stands is in contact exactly if
// it was in the frame before. All contacts of that frame are known, by induction: in the first, all pairs were tested. Boxes depend on
// corners only, so the pair is among the pairs found in both. No contact is there twice: pairs that stand are not tested.
#pragma once

#include <cstdint>
#include <optional>

#include "builders/input.h"
#include "builders/stages/kernel_form.h"
#include "collide/collider.h"

namespace bvhbench {

class StandingContacts {
public:
    StandingContacts(Programs& programs, KernelForm form);

    /// Begins a frame in whose lists of pairs there is `room`. `contacts`: all of the last frame, or nothing if they are not known or do
    /// not pay; then none stands. Nor does one if they are more than `room`. Not timed: it copies the contacts, where a simulation would
    /// swap two lists. Blocks.
    void begin(const Input& input, const std::optional<DevicePairs>& contacts, std::size_t room,
               Queue& queue);

    /// Picks in the present stage, of the pairs found, `most` at most, those that do not stand. None stands if the pairs have got more
    /// room since the frame began. `before`: points of the last frame. Does not block, nor does the next function.
    void pick(const DevicePairs& found, std::size_t most, const Buffer<Point>& before,
              const Input& input, Queue& queue);

    /// Appends the contacts that stand in the present stage.
    void append_to(const DevicePairs& contacts, Queue& queue);

    /// Those of the pairs found that are to be tested for contact.
    DevicePairs to_test(const DevicePairs& found) const { return stand_ ? moving_ : found; }

    /// Bytes of device memory reserved at present, for lists of two kinds and a byte a triangle.
    std::size_t bytes() const { return arena_ ? arena_->used().total() : 0; }

private:
    void launch(cl::Kernel& kernel, std::size_t items, std::int64_t moved_bytes, Queue& queue);
    void copy_those(bool standing, const DevicePairs& from, std::size_t most,
                    std::int64_t moved_bytes, const DevicePairs& to, Queue& queue);

    Programs& programs_;
    KernelForm form_;
    std::size_t chunks_;
    cl::Kernel mark_, copy_;
    std::optional<Arena> arena_;
    Buffer<std::uint8_t> moved_;  ///< of each triangle, 1 if it has moved since the last frame
    Buffer<Pair> blocks_;         ///< of the chunk form
    DevicePairs moving_;          ///< pairs found that do not stand
    DevicePairs kept_;            ///< contacts of the last frame
    std::uint64_t kept_count_ = 0;
    bool stand_ = false;  ///< whether contacts may stand in this frame
};

}  // namespace bvhbench
