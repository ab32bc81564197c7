// SPDX-License-Identifier: MIT
#include "harness/session/sample_lock.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <future>

#include "geometry/error.h"

namespace bvhbench {
namespace {

using namespace std::chrono_literals;

class SampleLockTest : public testing::Test {
protected:
    void TearDown() override
    {
        unsetenv("BVHBENCH_SAMPLE_LOCK");
        std::filesystem::remove(path_);
    }
    const std::string path_ =
        std::filesystem::temp_directory_path() / ("sample-lock-" + std::to_string(getpid()));
};

TEST_F(SampleLockTest, LetsOneRunTakeSamples)
{
    setenv("BVHBENCH_SAMPLE_LOCK", path_.c_str(), 1);
    std::future<void> other;
    {
        const SampleLock first;
        other = std::async(std::launch::async, [] { const SampleLock second; });
        EXPECT_EQ(other.wait_for(200ms), std::future_status::timeout);
    }
    EXPECT_EQ(other.wait_for(600s), std::future_status::ready);
}

TEST_F(SampleLockTest, DoesNothingWithoutTheVariable)
{
    const SampleLock first, second;
    EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(SampleLockTest, RefusesAFileThatCannotBeWritten)
{
    setenv("BVHBENCH_SAMPLE_LOCK", (path_ + "/none/file").c_str(), 1);
    EXPECT_THROW(const SampleLock refused, Unavailable);
}

}  // namespace
}  // namespace bvhbench
