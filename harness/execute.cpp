// SPDX-License-Identifier: MIT
#include <iostream>

#include "harness/commands.h"

namespace bvhbench {
namespace {

struct Executor {
    const Options& options;

    int operator()(const PrintCommand& command) const
    {
        std::cout << command.text;
        return 0;
    }
    int operator()(const ListCommand& command) const { return list(command, options); }
    int operator()(const BuildCommand& command) const { return build(command, options); }
    int operator()(const CollideCommand& command) const { return collide(command, options); }
    int operator()(const RunCommand& command) const { return run(command, options); }
    int operator()(const ReproduceCommand& command) const { return reproduce(command, options); }
    int operator()(const CheckCommand& command) const { return check(command, options); }
    int operator()(const ShowCommand& command) const { return show(command, options); }
    int operator()(const TuneCommand& command) const { return tune(command, options); }
    int operator()(const AccuracyCommand& command) const { return accuracy(command, options); }
    int operator()(const StressCommand& command) const { return stress(command, options); }
};

}  // namespace

int execute(const Options& options) { return std::visit(Executor{options}, options.command); }

}  // namespace bvhbench
