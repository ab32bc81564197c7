// SPDX-License-Identifier: MIT
#include "builders/stages/number.h"

#include "geometry/bits.h"

namespace bvhbench {

NumberAll::NumberAll(Programs& programs)
    : kernel_(programs.kernel("builders/stages/number.cl", "number_all"))
{}

void NumberAll::enqueue(const Buffer<uint>& numbers, Queue& queue)
{
    constexpr uint group_size = 256;
    const auto count = static_cast<uint>(numbers.size());
    if (count == 0)
        return;
    set_arguments(kernel_, numbers, count);
    queue.launch(kernel_, std::size_t{divided_up(count, group_size)} * group_size, group_size,
                 static_cast<std::int64_t>(numbers.bytes()));
}

}  // namespace bvhbench
