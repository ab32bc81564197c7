// SPDX-License-Identifier: MIT
// check:

/// Takes `steps` steps, each of which needs the one before, and leaves in `word` where they lead.
kernel void take_steps(global uint* word, const uint steps)
{
    uint x = 0u;
    for (uint step = 0u; step < steps; ++step)
        x = (x ^ step) * 1664525u + 1013904223u;
    word[0] = x;
}
