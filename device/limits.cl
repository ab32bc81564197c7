// SPDX-License-Identifier: MIT
//
// Kernels that measure a device's limits. They share one program, because PoCL takes some 40 ms to load each program at start.

/// Copies `count` vectors from `from` to `to`. Neighbouring work-items access neighbouring vectors.
kernel void copy_strided(global const uint4* restrict from, global uint4* restrict to,
                         const uint count)
{
    for (uint i = get_global_id(0); i < count; i += get_global_size(0))
        to[i] = from[i];
}

/// Copies `count` vectors from `from` to `to`. Each work-item copies a contiguous run, which suits the caches of CPU cores.
kernel void copy_runs(global const uint4* restrict from, global uint4* restrict to,
                      const uint count)
{
    const uint run = (count + get_global_size(0) - 1u) / get_global_size(0);
    const uint begin = min(run * (uint)get_global_id(0), count);
    const uint end = min(begin + run, count);
    for (uint i = begin; i < end; ++i)
        to[i] = from[i];
}

/// Reads `word`, which holds 0, and writes nothing. The conditional write keeps the compiler from removing the read.
kernel void launch_empty(global uint* word)
{
    if (word[0] == 1u)
        word[0] = 2u;
}

/// Computes `rounds` dependent steps to pass time. `word` holds 0 before and after.
kernel void keep_busy(global uint* word, const uint rounds)
{
    uint x = word[0];
    for (uint round = 0u; round < rounds; ++round)
        x = (x ^ round) * 1664525u + 1013904223u;
    if (x == 1u)  // keeps the compiler from removing the loop
        word[0] = 0u;
}

/// Reads and writes all `count` vectors of `memory`, which evicts everything else from the caches.
kernel void walk(global uint4* memory, const uint count)
{
    for (uint i = get_global_id(0); i < count; i += get_global_size(0))
        memory[i] += 1u;
}

/// A fixed amount of arithmetic and memory work: `rounds` steps on each of `count` vectors.
kernel void calibrate(global uint4* memory, const uint count, const uint rounds)
{
    for (uint i = get_global_id(0); i < count; i += get_global_size(0)) {
        uint4 x = memory[i];
        for (uint round = 0u; round < rounds; ++round)
            x = (x ^ (x >> 7u)) * 1664525u + round;
        memory[i] = x;
    }
}

/// Computes `steps` dependent steps and writes the result to `word`. The host compares it with its own.
kernel void take_steps(global uint* word, const uint steps)
{
    uint x = 0u;
    for (uint step = 0u; step < steps; ++step)
        x = (x ^ step) * 1664525u + 1013904223u;
    word[0] = x;
}
