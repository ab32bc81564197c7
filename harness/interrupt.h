// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace bvhbench {

/// The user or the system asked the program to stop. What was finished is written before main sees this.
class Interrupted : public std::runtime_error {
public:
    explicit Interrupted(int signal);
    int signal() const { return signal_; }

private:
    int signal_;
};

/// From here on SIGINT and SIGTERM are only remembered, once: a second one ends the program as usual.
void remember_interrupts();

/// Whether one has come. For code that must not throw.
bool is_interrupted();

/// Throws Interrupted if one has come. Called between samples and between cells.
void throw_if_interrupted();

}  // namespace bvhbench
