// SPDX-License-Identifier: MIT

/// Does nothing that can be seen: `word` is written only if it holds 1, and it holds 0.
kernel void launch_empty(global uint* word)
{
    if (word[0] == 1u)
        word[0] = 2u;
}
