// SPDX-License-Identifier: MIT

/// numbers[k] is k, for all `count`.
kernel void number_all(global uint* restrict numbers, const uint count)
{
    const uint k = (uint)get_global_id(0);
    if (k < count)
        numbers[k] = k;
}
