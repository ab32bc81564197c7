// SPDX-License-Identifier: MIT
#include "harness/commands.h"
#include "harness/interrupt.h"
#include "scenes/mesh_worker.h"

int main(int argc, char** argv)
{
    using namespace bvhbench;
    // Files from outside are read by a process of their own: this program again, under a flag of its own.
    if (is_mesh_worker(argc, argv))
        return mesh_worker_main(argc, argv);
    remember_interrupts();
    return run_program(argc, argv);
}
