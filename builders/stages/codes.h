// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "builders/orders.h"
#include "builders/stages/object_runs.h"
#include "device/program.h"
#include "geometry/bits.h"
#include "geometry/scene_bounds.h"

namespace bvhbench {

/// Returns the 32-bit words of a code in device memory: one, or two with the low word first.
constexpr uint code_words(unsigned code_bits) { return code_bits > 32 ? 2 : 1; }

/// Returns the bits of a box's code that are kept below the object number: as many as the code's words have room for, or the 24 bits
/// of a code that is sorted in a pass less.
constexpr uint kept_code_bits(unsigned code_bits, std::size_t objects)
{
    const uint object_bits = ceil_log2(static_cast<uint>(objects));
    const uint room = std::max(code_bits, object_bits) <= 24 ? 24 : 32 * code_words(code_bits);
    return std::min(code_bits, room - object_bits);
}

/// Stage `codes`: computes one code of code_words() words per leaf box, in an order of the catalog. With several objects a code
/// has the object number from bit kept_code_bits() on, and below it the highest bits of the box's code. `bounds` holds one
/// element per object, or one for all. Owns no memory.
class CodesStage {
public:
    CodesStage(Programs& programs, const OrderEntry& order, KernelForm form = KernelForm::of_device,
               std::size_t objects = 1);

    /// Enqueues the codes of all `boxes`; `owners` holds the object of each box. Does not block.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                 const Buffer<uint>& owners, const Buffer<uint>& codes, Queue& queue);

    /// Prepares enqueue_counted, for a device with local memory.
    void plan_counting();

    /// As `enqueue`, and adds the counts of the codes' digits to `counters` (RadixSort::counters). `bits` are those of a code and its
    /// object number.
    void enqueue_counted(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                         const Buffer<uint>& owners, const Buffer<uint>& codes,
                         const Buffer<uint>& counters, uint bits, Queue& queue);

    /// Enqueues the codes of the objects that `runs` reorders (at least one, of several), stored one object after the other.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds, const ObjectRuns& runs,
                 const Buffer<uint>& codes, Queue& queue);

    /// Returns the defines of kernels that compute codes (code_of.clh).
    std::vector<Define> defines() const;

private:
    Programs& programs_;
    const OrderEntry& order_;
    bool is_forest_;
    uint words_;
    uint kept_, dropped_;  ///< Bits of a box's code.
    uint group_size_;
    KernelForm form_;
    std::size_t chunks_;
    cl::Kernel kernel_, runs_kernel_, counted_kernel_;
};

}  // namespace bvhbench
