// SPDX-License-Identifier: MIT
//
// Stands before libuipc's header of this name, which needs spdlog and cpptrace: its trees only assert.
#pragma once

#include <cstdio>
#include <cstdlib>

#define UIPC_ASSERT(condition, ...)                                          \
    do {                                                                     \
        if (!(condition)) {                                                  \
            std::fprintf(stderr, "libuipc: %s does not hold\n", #condition); \
            std::abort();                                                    \
        }                                                                    \
    } while (false)
