// SPDX-License-Identifier: MIT
#include <iostream>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/commands.h"
#include "harness/failure.h"
#include "harness/printable.h"

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
    int operator()(const SweepCommand& command) const { return sweep(command, options); }
    int operator()(const MergeCommand& command) const { return merge(command, options); }
    int operator()(const PlotCommand& command) const { return plot(command, options); }
    int operator()(const ReportCommand& command) const { return report(command, options); }
    int operator()(const CompareCommand& command) const { return compare(command, options); }
    int operator()(const SmokeCommand& command) const { return smoke(command, options); }
};

int failed(const std::exception& error, int code)
{
    std::cerr << "bvhbench: " << sentence_of(error) << '\n';
    return code;
}

}  // namespace

int execute(const Options& options) { return std::visit(Executor{options}, options.command); }

int run_program(int argc, const char* const* argv)
{
    const PrintableOutput output(std::cout), errors(std::cerr);
    try {
        const Options options = parse_options(argc, argv);
        limit_host_memory(options.common.memory_limit);
        const int code = execute(options);
        if (!std::cout.flush())
            throw Unavailable("standard output cannot be written: what was printed is lost");
        return code;
    } catch (const BadUsage& error) {
        return failed(error, 2);
    } catch (const NothingMeasured& error) {
        return failed(error, 4);
    } catch (const std::exception& error) {  // Unavailable, BuildFailure, cl::Error, bad_alloc
        return failed(error, 3);
    }
}

}  // namespace bvhbench
