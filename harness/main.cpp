// SPDX-License-Identifier: MIT
#include <fcntl.h>

#include <csignal>

#include "harness/commands/program.h"
#include "harness/stress/libraries.h"
#include "scenes/mesh_worker.h"
#include "scenes/worker/process.h"

namespace {

/// Standard input, output and error that this process was started without would be taken by the next files it opens: what
/// is printed would go into those. So their places are taken by what cannot be used.
void hold_standard_streams()
{
    for (int file = 0; file < 3; ++file)
        if (fcntl(file, F_GETFD) < 0)
            open("/dev/null", file == 0 ? O_WRONLY : O_RDONLY);
}

}  // namespace

int main(int argc, char** argv)
{
    using namespace bvhbench;
    hold_standard_streams();
    end_with_parent();
    // Files from outside are read and libraries put under stress by a process of their own: this program again.
    if (is_mesh_worker(argc, argv))
        return mesh_worker_main(argc, argv);
    if (is_library_worker(argc, argv))
        return library_worker_main(argc, argv);
    std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit of its size is an error of write()
    return run_program(argc, argv);
}
