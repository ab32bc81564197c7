// SPDX-License-Identifier: MIT
#include "process/watchdog.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "geometry/error.h"
#include "harness/measure/frame_oracle.h"
#include "process/interrupt.h"

namespace bvhbench {
namespace {

/// Ends the process with code 3 and says on standard error how `work` crashed in a child.
[[noreturn]] void tell_end_of(void (*work)())
{
    try {
        supervised(600, [work] {
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

void fault()
{
    std::signal(SIGSEGV, SIG_DFL);  // a library may have a handler that returns
    std::raise(SIGSEGV);
}

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

/// Works in a cell of a run that goes on after a loss. Ends the process with code 3, and says on standard error why the cell was lost
/// and why `work` failed.
[[noreturn]] void tell_failure_of(void (*work)())
{
    std::_Exit(supervised(0.2, [work] {
        watchdog::resume_after_crash("a run");
        const watchdog::CellScope scope("a cell");
        try {
            work();
        } catch (const Unavailable& error) {
            std::cerr << watchdog::given_up("a cell") << error.what() << '\n';
            return 3;
        }
        return 0;
    }));
}

void ask_an_oracle_that_hangs()
{
    const Expected expected(1, "contacts", {}, [](OracleProgress&) -> Answer {
        for (;;)
            pause();
    });
    expected.list();
}

void crash_after_an_oracle()
{
    const Expected expected(1, "contacts", {}, [](OracleProgress&) { return Answer({}, {}); });
    expected.list();
    if (watchdog::given_up("a cell").empty())
        fault();
    throw Unavailable("");
}

TEST(Watchdog, GivesUpTheOracleThatHangsAndNotTheCell)
{
    EXPECT_EXIT(tell_failure_of(&ask_an_oracle_that_hangs), testing::ExitedWithCode(3),
                "^the oracle of contacts took longer than 0.2 s and was ended; --time-limit gives "
                "it more\n$");
}

TEST(Watchdog, GivesUpTheCellThatCrashesAfterAnOracle)
{
    EXPECT_EXIT(tell_failure_of(&crash_after_an_oracle), testing::ExitedWithCode(3),
                "^crashed .signal 11.");
}

TEST(Watchdog, PassesASignalOfTheMomentBetweenTwoChildrenOnToTheSecond)
{
    const auto work = [] {
        if (!watchdog::run_id().empty()) {
            const AtSignal kept([] {}, "kept");
            watchdog::let_signals_through();
            sleep(600);
        }
        watchdog::resume_after_crash("a run");
        watchdog::begin_another();
        kill(getppid(), SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(500));  // the parent passes it on
        return 0;
    };
    EXPECT_EXIT(std::_Exit(supervised(600, work)), testing::ExitedWithCode(128 + SIGTERM),
                "^bvhbench: stopped; kept\n$");
}

}  // namespace
}  // namespace bvhbench
