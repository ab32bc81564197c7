// SPDX-License-Identifier: MIT

/// `to` holds `count` vectors of `from` afterwards. Neighbours in a group touch neighbouring vectors.
kernel void copy(global const uint4* restrict from, global uint4* restrict to, const uint count)
{
    for (uint i = get_global_id(0); i < count; i += get_global_size(0))
        to[i] = from[i];
}
