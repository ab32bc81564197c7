// SPDX-License-Identifier: MIT
#include "harness/session/turns.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "geometry/error.h"

namespace bvhbench {
namespace {

using namespace std::chrono_literals;

/// The name of a file that is not there.
class FreshFile {
public:
    FreshFile() { remove(); }
    ~FreshFile() { remove(); }
    FreshFile(const FreshFile&) = delete;
    FreshFile& operator=(const FreshFile&) = delete;
    static void remove()
    {
        std::filesystem::remove(path());
        std::filesystem::remove(path() + ".last");
    }
    static std::string path()
    {
        return std::filesystem::temp_directory_path() / ("turns-" + std::to_string(getpid()));
    }
};

TEST(Turns, AreTakenOneAtATimeAndByAll)
{
    const FreshFile file;
    std::atomic<int> inside = 0;
    std::atomic<int> most = 0;
    std::string sequence;  // written only by whose turn it is
    const auto run = [&](char name) {
        Turns turns(FreshFile::path(), 2, std::string(1, name));
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
    EXPECT_GT(changes, 60)
        << sequence;  // 99, if neither is ever twice in a row; a loaded machine may be late
}

TEST(Turns, BeginWhenAllHaveCome)
{
    const FreshFile file;
    Turns first(FreshFile::path(), 2, "first");
    std::atomic<bool> has_met = false;
    std::thread waiting([&] {
        first.meet();
        has_met = true;
    });
    std::this_thread::sleep_for(50ms);
    EXPECT_FALSE(has_met);
    Turns second(FreshFile::path(), 2, "second");
    second.meet();
    waiting.join();
    EXPECT_TRUE(has_met);
    EXPECT_THROW(Turns(FreshFile::path(), 2, "third"), BadUsage);
    EXPECT_THROW(Turns("/nowhere/turns", 2, "x"), Unavailable);
}

TEST(Turns, PartWhenAllHaveEnough)
{
    const FreshFile file;
    std::atomic<bool> has_parted = false;
    std::thread early([&] {
        Turns turns(FreshFile::path(), 2, "early");
        turns.meet();
        turns.part();
        has_parted = true;
        turns.meet();  // of the next scene
    });
    Turns late(FreshFile::path(), 2, "late");
    late.meet();
    std::this_thread::sleep_for(50ms);
    EXPECT_FALSE(has_parted);
    late.part();
    late.meet();
    early.join();
    EXPECT_TRUE(has_parted);
}

TEST(Turns, OfNobodyAreNone)
{
    const Turns::Turn turn(nullptr);
    SUCCEED();
}

}  // namespace
}  // namespace bvhbench
