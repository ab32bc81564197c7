// SPDX-License-Identifier: MIT
#include <csignal>

#include "harness/commands.h"
#include "harness/interrupt.h"
#include "harness/stress/libraries.h"
#include "harness/sweep/facts_worker.h"
#include "scenes/mesh_worker.h"
#include "scenes/worker/worker.h"

int main(int argc, char** argv)
{
    using namespace bvhbench;
    end_with_parent();
    // Files from outside are read, libraries put under stress and sweeps' devices looked at by a process of their own: this
    // program again.
    if (is_mesh_worker(argc, argv))
        return mesh_worker_main(argc, argv);
    if (is_library_worker(argc, argv))
        return library_worker_main(argc, argv);
    if (is_facts_worker(argc, argv))
        return facts_worker_main(argc, argv);
    std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit of its size is an error of write()
    end_on_signals();
    return run_program(argc, argv);
}
