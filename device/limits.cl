// SPDX-License-Identifier: MIT
//
// What a device's limits are measured by. One text, because PoCL takes some 40 ms to read a program back at every start.

/// `to` holds `count` vectors of `from` afterwards. Neighbours in a group touch neighbouring vectors.
kernel void copy_strided(global const uint4* restrict from, global uint4* restrict to,
                         const uint count)
{
    for (uint i = get_global_id(0); i < count; i += get_global_size(0))
        to[i] = from[i];
}

/// The same with a contiguous run a work-item, which is what a core's caches want.
kernel void copy_runs(global const uint4* restrict from, global uint4* restrict to,
                      const uint count)
{
    const uint run = (count + get_global_size(0) - 1u) / get_global_size(0);
    const uint begin = min(run * (uint)get_global_id(0), count);
    const uint end = min(begin + run, count);
    for (uint i = begin; i < end; ++i)
        to[i] = from[i];
}

/// Does nothing that can be seen: `word` is written only if it holds 1, and it holds 0.
kernel void launch_empty(global uint* word)
{
    if (word[0] == 1u)
        word[0] = 2u;
}

/// Takes its time: `rounds` steps, each of which needs the one before. `word` holds 0 before and after.
kernel void keep_busy(global uint* word, const uint rounds)
{
    uint x = word[0];
    for (uint round = 0u; round < rounds; ++round)
        x = (x ^ round) * 1664525u + 1013904223u;
    if (x == 1u)  // the compiler cannot know, so it cannot leave the steps out
        word[0] = 0u;
}

/// Reads and writes all of `memory`, `count` vectors, so that afterwards no cache holds anything else.
kernel void walk(global uint4* memory, const uint count)
{
    for (uint i = get_global_id(0); i < count; i += get_global_size(0))
        memory[i] += 1u;
}

/// A fixed piece of work, some of it arithmetic and some of it memory: each of `count` vectors takes `rounds` steps.
kernel void calibrate(global uint4* memory, const uint count, const uint rounds)
{
    for (uint i = get_global_id(0); i < count; i += get_global_size(0)) {
        uint4 x = memory[i];
        for (uint round = 0u; round < rounds; ++round)
            x = (x ^ (x >> 7u)) * 1664525u + round;
        memory[i] = x;
    }
}

/// Takes `steps` steps, each of which needs the one before, and leaves in `word` where they lead.
kernel void take_steps(global uint* word, const uint steps)
{
    uint x = 0u;
    for (uint step = 0u; step < steps; ++step)
        x = (x ^ step) * 1664525u + 1013904223u;
    word[0] = x;
}
