// SPDX-License-Identifier: MIT
#include <fcntl.h>

#include <csignal>

#include "harness/commands/command.h"
#include "harness/stress/libraries.h"
#include "plugins/worker.h"
#include "process/child.h"
#include "scenes/mesh_worker.h"

namespace {

/// Opens /dev/null on standard streams that are closed. Otherwise the next opened files would get their descriptors, and printed
/// text would go into those files. The modes are chosen so that reading standard input and writing to the others fail.
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
    // These workers are this same program in a child process: one reads mesh files, one runs libraries under stress,
    // one runs builders and colliders from outside.
    if (is_mesh_worker(argc, argv))
        return mesh_worker_main(argc, argv);
    if (is_library_worker(argc, argv))
        return library_worker_main(argc, argv);
    if (outside::is_worker(argc, argv))
        return outside::worker_main(argc, argv);
    std::signal(SIGXFSZ, SIG_IGN);  // writing past the file size limit then makes write() fail
    return run_program(argc, argv);
}
