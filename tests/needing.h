// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include "collide/oracles/exact_reference.h"

namespace bvhbench {

inline constexpr std::string_view cgal_absent =
    has_exact_reference ? "" : "built without CGAL: nothing is compared";

/// Tests that are skipped if `absent` says that the build lacks what they need.
template <class Test, const std::string_view& absent>
class Needing : public Test {
protected:
    void SetUp() override
    {
        if (!absent.empty())
            GTEST_SKIP() << absent;
    }
};

}  // namespace bvhbench
