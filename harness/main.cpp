// SPDX-License-Identifier: MIT
//
// Exit codes: 0 done, 1 a check differs, 2 wrong usage, 3 no device, file, library or memory,
// 128 + signal when stopped.
#include <iostream>

#include "geometry/error.h"
#include "harness/commands.h"
#include "harness/failure.h"
#include "harness/interrupt.h"
#include "harness/stress/libraries.h"
#include "scenes/mesh_worker.h"

namespace {

int failed(const std::exception& error, int code)
{
    std::cerr << "bvhbench: " << bvhbench::sentence_of(error) << '\n';
    return code;
}

}  // namespace

int main(int argc, char** argv)
{
    using namespace bvhbench;
    // Files from outside are read, and libraries put under stress, by a process of their own: this program again.
    if (is_mesh_worker(argc, argv))
        return mesh_worker_main(argc, argv);
    if (is_library_worker(argc, argv))
        return library_worker_main(argc, argv);
    try {
        remember_interrupts();
        return execute(parse_options(argc, argv));
    } catch (const BadUsage& error) {
        return failed(error, 2);
    } catch (const Interrupted& error) {
        return failed(error, 128 + error.signal());
    } catch (const std::exception& error) {  // Unavailable, BuildFailure, cl::Error, bad_alloc
        return failed(error, 3);
    }
}
