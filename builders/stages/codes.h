// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "builders/orders.h"
#include "builders/stages/object_runs.h"
#include "device/program.h"
#include "geometry/bits.h"
#include "geometry/scene_bounds.h"

namespace bvhbench {

/// 32-bit words a code takes in device memory: one, or two with the low word first.
constexpr uint code_words(unsigned code_bits) { return code_bits > 32 ? 2 : 1; }

/// Bits of a code that are kept below the number of one of so many objects: as many as its words have room for.
constexpr uint kept_code_bits(unsigned code_bits, std::size_t objects)
{
    const uint object_bits = ceil_log2(static_cast<uint>(objects));
    return std::min(code_bits, 32 * code_words(code_bits) - object_bits);
}

/// The stage `codes`: one code a leaf box, by an order of the catalog, of code_words() words each. Of several objects a code
/// is the object, from bit kept_code_bits() on, and below it the box's, without the bits that are not kept. Owns no memory.
/// `bounds` are one an object, or of all together.
class CodesStage {
public:
    CodesStage(Programs& programs, const OrderEntry& order, KernelForm form = KernelForm::of_device,
               std::size_t objects = 1);

    /// Enqueue: `codes` gets the codes of all `boxes`, whose objects are `owners`. Does not wait.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                 const Buffer<uint>& owners, const Buffer<uint>& codes, Queue& queue);

    /// The same of the objects that `runs` lines up, at least one of several: their codes one object behind the other.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds, const ObjectRuns& runs,
                 const Buffer<uint>& codes, Queue& queue);

private:
    uint words_;
    uint kept_, dropped_;  ///< bits of a box's code
    uint group_size_;
    KernelForm form_;
    std::size_t chunks_;
    cl::Kernel kernel_, runs_kernel_;
};

}  // namespace bvhbench
