// SPDX-License-Identifier: MIT
#include "harness/session/watchdog.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <iostream>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// Ends the process with code 3 and says on standard error how `work` crashed in a child.
[[noreturn]] void tell_end_of(void (*work)())
{
    try {
        supervised(60, [work] {
            watchdog::kernels_are_in("/kernels");
            work();
            return 0;
        });
    } catch (const Unavailable& error) {
        std::cerr << error.what() << '\n';
        std::_Exit(3);
    }
    std::_Exit(0);
}

void fault() { std::raise(SIGSEGV); }

void limit_address_space()
{
    const rlimit large{rlim_t{1} << 46, RLIM_INFINITY};
    setrlimit(RLIMIT_AS, &large);
}

TEST(Watchdog, DoesNotBlameKernelsForAnAbortOfTheProgram)
{
    EXPECT_EXIT(tell_end_of(&std::abort), testing::ExitedWithCode(3), "crashed .signal 6.\n$");
}

TEST(Watchdog, TellsThatDamagedKernelsCanBeWhyItCrashed)
{
    EXPECT_EXIT(tell_end_of(&fault), testing::ExitedWithCode(3),
                "crashed .signal 11.; damaged kernels .* can be why: remove /kernels\n$");
}

TEST(Watchdog, NamesALimitOfAddressSpaceInstead)
{
    EXPECT_EXIT((limit_address_space(), tell_end_of(&fault)), testing::ExitedWithCode(3),
                "crashed .signal 11.; the limit of address space .ulimit -v. can be why");
}

}  // namespace
}  // namespace bvhbench
