// SPDX-License-Identifier: MIT
#include "harness/record/result_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

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

    fs::path folder_;
};

TEST_F(ResultFileTest, IsCompleteAfterFinishAndWhenTheRunEndsEarly)
{
    for (const bool finishes : {true, false}) {
        const fs::path path = folder_ / (finishes ? "finished.json" : "early.json");
        std::string text;
        {
            ResultFile file({path, "--out", {}}, fake_run());
            for (int i = 0; i < 20; ++i)
                file.add(fake_cell());
            if (finishes)
                file.finish({.compile_ns = 77});
            EXPECT_EQ(file.exit_code(), 0);
            text = file.text();
        }
        const Json document = Json::parse(text_of(path));
        EXPECT_EQ(document["cells"].size(), 20u);
        EXPECT_EQ(document["run"]["compile_ns"], finishes ? 77 : 5000);
        EXPECT_EQ(document["run"].contains("finished_at"), finishes);
        EXPECT_TRUE(!finishes || text == text_of(path));
    }
}

TEST_F(ResultFileTest, GoesOnWithTheCellsThatAnEarlierProcessOfTheRunHasLeft)
{
    const fs::path path = folder_ / "r.json";
    Json run = fake_run();
    {
        ResultFile file({path, "--out", {}}, run);
        Cell wrong = fake_cell();
        wrong.check.verdict = Check::Verdict::differs;
        file.add(wrong);
        file.add(fake_cell());
        file.finish({.compile_ns = 1});
    }
    run["started_at"] = "later";
    ResultFile file({path, "--out", result_rules(false, {}, run["id"])}, run, run["id"]);
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
    Output(path, "--out", {}).replace("older");
    {
        const ResultFile file({path, "--out", {.force = true}}, fake_run());
    }
    EXPECT_EQ(text_of(path), "older");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

}  // namespace
}  // namespace bvhbench
