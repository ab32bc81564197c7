// SPDX-License-Identifier: MIT
#include "harness/commands.h"
#include "harness/interrupt.h"
#include "harness/stress/libraries.h"
#include "scenes/mesh_worker.h"

int main(int argc, char** argv)
{
    using namespace bvhbench;
    // Files from outside are read, and libraries put under stress, by a process of their own: this program again.
    if (is_mesh_worker(argc, argv))
        return mesh_worker_main(argc, argv);
    if (is_library_worker(argc, argv))
        return library_worker_main(argc, argv);
    remember_interrupts();
    return run_program(argc, argv);
}
