// SPDX-License-Identifier: MIT
#include <iostream>

#include "harness/commands.h"
#include "harness/plot.h"

namespace bvhbench {

int plot(const PlotCommand& command, const Options& options)
{
    draw_all(command.files, command.out, options.common.force);
    std::cout << "drawn into " << command.out << '\n';
    return 0;
}

}  // namespace bvhbench
