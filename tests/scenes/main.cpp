// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "scenes/mesh_worker.h"

int main(int argc, char** argv)
{
    if (bvhbench::is_mesh_worker(argc, argv))
        return bvhbench::mesh_worker_main(argc, argv);
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
