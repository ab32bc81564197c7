// SPDX-License-Identifier: MIT
#include "tests/cluster/rank_tests.h"

int main(int argc, char** argv)
{
    return bvhbench::run_rank_tests(argc, argv, bvhbench::usual_most_at_once);
}
