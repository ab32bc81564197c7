// SPDX-License-Identifier: MIT
#include "harness/interrupt.h"

#include <csignal>

namespace bvhbench {
namespace {

// The one global of the program: a signal handler has no other way to leave word.
volatile std::sig_atomic_t received = 0;

void remember(int signal) { received = signal; }

}  // namespace

Interrupted::Interrupted(int signal)
    : std::runtime_error("stopped; finished cells are kept"), signal_(signal)
{}

void remember_interrupts()
{
    struct sigaction action = {};
    action.sa_handler = remember;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() { return received != 0; }

void throw_if_interrupted()
{
    if (received != 0)
        throw Interrupted(received);
}

}  // namespace bvhbench
