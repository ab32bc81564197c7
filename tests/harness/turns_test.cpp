// SPDX-License-Identifier: MIT
#include "harness/session/turns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "geometry/error.h"
#include "tests/folder.h"

namespace bvhbench {
namespace {

using namespace std::chrono_literals;

/// Provides the name of a file that does not exist.
class TurnsTest : public testing::Test {
protected:
    const Folder folder_;
    const std::string path_ = folder_.path() / "turns";
};

TEST_F(TurnsTest, AreTakenOneAtATimeAndByAll)
{
    std::atomic<int> inside = 0;
    std::atomic<int> most = 0;
    std::string sequence;  // written only by the thread whose turn it is
    const auto run = [&](char name) {
        Turns turns(path_, 2, std::string(1, name));
        turns.meet();
        for (int round = 0; round < 50; ++round) {
            const Turns::Turn turn(&turns);
            most = std::max(most.load(), ++inside);
            sequence += name;
            std::this_thread::sleep_for(1ms);
            --inside;
        }
        EXPECT_EQ(turns.others(), std::set<std::string>({name == 'a' ? "b" : "a"}));
    };
    std::thread other(run, 'b');
    run('a');
    other.join();
    EXPECT_EQ(most, 1);
    int changes = 0;
    for (std::size_t i = 1; i < sequence.size(); ++i)
        changes += sequence[i] != sequence[i - 1] ? 1 : 0;
    // Strict alternation gives 99 changes. A run that a loaded machine holds up misses turns; without turns there is one change.
    EXPECT_GT(changes, 1) << sequence;
    EXPECT_EQ(std::ranges::count(sequence, 'a'), std::ranges::count(sequence, 'b'));
}

TEST_F(TurnsTest, BeginWhenAllHaveComeAndPartWhenAllHaveEnough)
{
    std::atomic<bool> has_met = false, has_parted = false;
    std::thread early([&] {
        Turns turns(path_, 2, "early");
        turns.meet();
        has_met = true;
        turns.part();
        has_parted = true;
        turns.meet();  // for the next scene
    });
    std::this_thread::sleep_for(50ms);
    EXPECT_FALSE(has_met);
    Turns late(path_, 2, "late");
    late.meet();
    std::this_thread::sleep_for(50ms);
    EXPECT_FALSE(has_parted);
    late.part();
    late.meet();
    early.join();
    EXPECT_TRUE(has_met && has_parted);
    EXPECT_THROW(Turns(path_, 2, "third"), BadUsage);
    EXPECT_THROW(Turns("/nowhere/turns", 2, "x"), Unavailable);
}

}  // namespace
}  // namespace bvhbench
