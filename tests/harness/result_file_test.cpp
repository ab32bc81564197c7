// SPDX-License-Identifier: MIT
#include "harness/record/result_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "geometry/error.h"
#include "harness/base/json_keys.h"
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

    static void write_atomically(const fs::path& path, const std::string& text)
    {
        Output(path, "--out", {.force = true}).replace(text);
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
    const Json document = Json::parse(text_of(path));
    EXPECT_EQ(document["cells"].size(), 20u);
    EXPECT_EQ(document["run"]["compile_ns"], 77);
    EXPECT_TRUE(document["run"].contains("finished_at"));
    EXPECT_EQ(file.text(), text_of(path));
    EXPECT_EQ(file.exit_code(), 0);
}

TEST_F(ResultFileTest, IsCompleteWhenTheRunEndsEarly)
{
    const fs::path path = folder_ / "r.json";
    {
        ResultFile file(output_at(path), fake_run());
        for (int i = 0; i < 20; ++i)
            file.add(fake_cell());
    }
    EXPECT_EQ(Json::parse(text_of(path))["cells"].size(), 20u);
}

TEST_F(ResultFileTest, GoesOnWithTheCellsThatAnEarlierProcessOfTheRunHasLeft)
{
    const fs::path path = folder_ / "r.json";
    RunFacts run = fake_run();
    {
        ResultFile file(output_at(path), run);
        Cell wrong = fake_cell();
        wrong.check.verdict = Check::Verdict::differs;
        file.add(wrong);
        file.add(fake_cell());
        file.finish(1);
    }
    run.started_at = "later";
    ResultFile file({path, "--out", result_rules(false, {}, run.id)}, run, run.id);
    EXPECT_EQ(file.next_order(), 10);
    EXPECT_TRUE(file.pass(1));
    EXPECT_FALSE(file.pass(2)) << "one of these is missing, so both are made anew";
    EXPECT_EQ(file.size(), 1u);
    EXPECT_EQ(file.exit_code(), 1);
    EXPECT_EQ(Json::parse(file.text())["run"]["started_at"], "2025-11-30T08:15:42Z");
}

TEST_F(ResultFileTest, OfCellsThatWereNotMeasuredSaysWhy)
{
    ResultFile file({}, fake_run());
    Cell cell = fake_cell();
    cell.status = Cell::Status::skipped;
    cell.reason = "no such scene";
    file.add(cell);
    EXPECT_THROW(file.exit_code(), NothingMeasured);
    EXPECT_THROW(Output(folder_, "--out", {}), BadUsage);
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
