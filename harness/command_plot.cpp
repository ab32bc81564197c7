// SPDX-License-Identifier: MIT
#include <iostream>

#include "harness/commands.h"
#include "harness/output.h"
#include "harness/plot.h"

namespace bvhbench {

int plot(const PlotCommand& command, const Options& options)
{
    make_folder(command.out);
    check_pictures(command.out, "--out", {.force = options.common.force, .inputs = command.files});
    draw_all(command.files, command.out, options.common.force);
    std::cout << "drawn into " << command.out << '\n';
    return 0;
}

}  // namespace bvhbench
