// SPDX-License-Identifier: MIT
#include "harness/result_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "geometry/error.h"
#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

class ResultFileTest : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ = fs::path(testing::TempDir()) / ("bvhbench-" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    static std::string text_of(const fs::path& path)
    {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    static Output output_at(const fs::path& path) { return {path, "--out", {}}; }

    fs::path folder_;
};

TEST_F(ResultFileTest, IsCompleteAfterFinish)
{
    const fs::path path = folder_ / "r.json";
    ResultFile file(output_at(path), fake_run());
    for (int i = 0; i < 20; ++i)
        file.add(fake_cell());
    file.finish(77);
    const Document document = read_document(text_of(path), "r");
    EXPECT_EQ(document.cells.size(), 20u);
    EXPECT_EQ(document.run.compile_ns, 77);
}

TEST_F(ResultFileTest, IsCompleteWhenTheRunEndsEarly)
{
    const fs::path path = folder_ / "r.json";
    {
        ResultFile file(output_at(path), fake_run());
        for (int i = 0; i < 20; ++i)
            file.add(fake_cell());
    }
    EXPECT_EQ(read_document(text_of(path), "r").cells.size(), 20u);
}

TEST_F(ResultFileTest, LeavesAnOlderFileAloneUntilThereIsACell)
{
    const fs::path path = folder_ / "r.json";
    write_atomically(path, "older");
    {
        const ResultFile file({path, "--out", {.force = true}}, fake_run());
    }
    EXPECT_EQ(text_of(path), "older");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(ResultFileTest, SaysAtOnceThatItCannotBeWritten)
{
    EXPECT_THROW(output_at("/proc/nowhere/r.json"), Unavailable);
}

TEST_F(ResultFileTest, IsWholeWheneverItsWriterIsKilled)
{
    const fs::path path = folder_ / "r.json";
    const std::string some(200000, 'a');
    const std::string other(300000, 'b');
    write_atomically(path, some);
    for (int attempt = 0; attempt < 10; ++attempt) {
        const pid_t child = fork();
        if (child == 0)
            for (bool odd = false;; odd = !odd)
                write_atomically(path, odd ? some : other);
        std::this_thread::sleep_for(std::chrono::milliseconds(5 + 7 * attempt));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        const std::string text = text_of(path);
        ASSERT_TRUE(text == some || text == other) << text.size() << " bytes";
    }
}

}  // namespace
}  // namespace bvhbench
