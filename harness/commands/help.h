// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {
class App;
}

namespace bvhbench {

/// Has `--help` of the program and of each of its commands show what commands() say of them, wrapped.
void add_help(CLI::App& app);

}  // namespace bvhbench
