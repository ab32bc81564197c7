// SPDX-License-Identifier: MIT
#include "harness/record/result_file.h"

#include <iterator>

#include "tests/folder.h"
#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

class ResultFileTest : public testing::Test {
protected:
    static std::string text_of(const fs::path& path)
    {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    const Folder made_;
    const fs::path folder_ = made_.path(), path_ = folder_ / "r.json",
                   journal_ = path_.string() + ".journal";
};

TEST_F(ResultFileTest, IsCompleteAfterFinishAndWhenTheRunEndsEarly)
{
    for (const bool finishes : {true, false}) {
        const fs::path path = folder_ / (finishes ? "finished.json" : "early.json");
        std::string text;
        {
            ResultFile file({path, "--out", {}}, false, fake_run());
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

Output resumed(const fs::path& path) { return {path, "--out", result_rules(false, {}, true)}; }

/// Leaves a run of two parts as a process that was killed does: one is complete, and of the other there is one cell, a wrong one.
void leave_killed(const fs::path& path)
{
    ResultFile file({path, "--out", {}}, false, Resuming{}, "");
    file.begin(fake_run());
    file.begin_part("0123");
    file.add(fake_cell());
    file.end_part(1.5);
    file.begin_part("4567");
    Cell wrong = fake_cell();
    wrong.check.verdict = Check::Verdict::differs;
    file.add(wrong);
    file.leave();
}

/// Adds a part whose only cell failed, and leaves the file.
void add_failed(ResultFile& file, double seconds)
{
    file.begin_part("0123");
    Cell failed = fake_cell();
    failed.status = Cell::Status::failed;
    file.add(failed);
    file.end_part(seconds);
    file.leave();
}

TEST_F(ResultFileTest, GoesOnWithTheCellsThatAnEarlierProcessOfTheRunHasLeft)
{
    leave_killed(path_);
    std::ofstream(journal_, std::ios::app) << "{\"part\": \"4567\", \"ce";
    EXPECT_FALSE(fs::exists(path_));
    ResultFile file({path_, "--out", {}}, false, Resuming{}, fake_run()["id"]);
    EXPECT_TRUE(file.has_begun());
    EXPECT_EQ(file.next_order(), 10);
    file.begin({});
    EXPECT_TRUE(text_of(journal_).ends_with("}\n")) << "the line that was cut off is gone";
    EXPECT_EQ(file.take_part("0123"), 1.5);
    EXPECT_EQ(file.take_part("4567"), std::nullopt) << "it has not ended";
    file.begin_part("4567");
    EXPECT_TRUE(file.pass(1));
    EXPECT_FALSE(file.pass(2)) << "one of these is missing, so both are made anew";
    EXPECT_EQ(file.size(), 2u);
    EXPECT_EQ(file.exit_code(), 1);
    file.finish({});
    const Json document = Json::parse(text_of(path_));
    EXPECT_EQ(document["run"]["started_at"], "2025-11-30T08:15:42Z");
    EXPECT_FALSE(document.contains("merged_from"));
    EXPECT_EQ(document["cells"][1]["part"], "4567");
    EXPECT_FALSE(fs::exists(journal_));
}

TEST_F(ResultFileTest, OfALaterRunKeepsWhatIsThereAndNamesBothRuns)
{
    leave_killed(path_);
    const std::string why =
        refusal_of<BadUsage>([&] { ResultFile(resumed(path_), false, Resuming{}, ""); });
    EXPECT_TRUE(contains(why, "did not end"));
    Json run = fake_run();
    run["id"] = "later";
    {
        ResultFile file(resumed(path_), false, Resuming{.is_asked = true}, "");
        EXPECT_FALSE(file.has_begun());
        EXPECT_EQ(file.next_order(), 0) << "of its own run there are no samples";
        EXPECT_TRUE(contains(refusal_of<BadUsage>([&] { file.check_earlier({"0123"}, run); }),
                             "1 of 2 parts"));
        file.check_earlier({"0123", "4567", "89ab"}, run);
        EXPECT_TRUE(file.take_part("0123"));
        file.begin(run);
        file.begin_part("4567");
        EXPECT_FALSE(file.pass(2));
        file.add(fake_cell("karras"));
        file.end_part(1);
        file.finish({});
    }
    const Json document = Json::parse(text_of(path_));
    EXPECT_EQ(document["merged_from"].size(), 2u);
    EXPECT_EQ(document["cells"].size(), 2u);
    EXPECT_EQ(document["cells"][0]["run"], fake_run()["id"]);
    EXPECT_EQ(document["cells"][1]["run"], "later");
    // A finished file is gone on with too, and nothing is left to do.
    ResultFile again(resumed(path_), false, Resuming{.is_asked = true}, "");
    EXPECT_TRUE(again.take_part("0123"));
    EXPECT_TRUE(again.take_part("4567"));
    EXPECT_EQ(again.take_part("89ab"), std::nullopt);
}

TEST_F(ResultFileTest, AfterAKillBetweenTheFileAndItsJournalHasEachCellOnce)
{
    leave_killed(path_);
    const std::string lines = text_of(journal_);
    {
        ResultFile file(resumed(path_), false, Resuming{.is_asked = true}, "");
    }
    EXPECT_FALSE(fs::exists(journal_));
    std::ofstream(journal_) << lines;
    ResultFile file(resumed(path_), false, Resuming{.is_asked = true}, "");
    EXPECT_FALSE(fs::exists(journal_));
    EXPECT_EQ(Json::parse(file.text())["cells"].size(), 2u);
    EXPECT_TRUE(file.take_part("0123"))
        << "a part that was complete stays so in a file that is not";
    EXPECT_FALSE(file.take_part("4567"));
}

TEST_F(ResultFileTest, AfterACrashInAPartThatWasMeasuredAgainHasItsNewCellsOnly)
{
    leave_killed(path_);
    const std::string id = fake_run()["id"];
    {
        ResultFile file({path_, "--out", {}}, false, Resuming{}, id);
        file.begin({});
        file.begin_part("4567");
        EXPECT_FALSE(file.pass(2));
        file.add(fake_cell("karras"));
        file.leave();
    }
    const ResultFile file({path_, "--out", {}}, false, Resuming{}, id);
    const Json cells = Json::parse(file.text())["cells"];
    ASSERT_EQ(cells.size(), 2u);
    EXPECT_EQ(cells[1]["builder"]["name"], "karras");
}

TEST_F(ResultFileTest, ThatEndsEarlyNamesThePartThatWasMeasured)
{
    {
        ResultFile file({path_, "--out", {}}, false, Resuming{}, "");
        file.begin(fake_run());
        for (const char* key : {"0123", "4567"}) {
            file.begin_part(key);
            file.add(fake_cell());
            if (std::string(key) == "0123")
                file.end_part(1);
        }
    }
    ResultFile file(resumed(path_), false, Resuming{.is_asked = true}, "");
    EXPECT_TRUE(file.take_part("0123"));
    EXPECT_FALSE(file.take_part("4567"));
}

TEST_F(ResultFileTest, ThatIsRefusedLeavesAllFilesAsTheyAre)
{
    leave_killed(path_);
    const std::string lines = text_of(journal_);
    {
        ResultFile file(resumed(path_), false, Resuming{.is_asked = true}, "");
        EXPECT_THROW(file.check_earlier({"0123"}, fake_run()), BadUsage);
    }
    EXPECT_EQ(text_of(journal_), lines);
    EXPECT_FALSE(fs::exists(path_));
}

TEST_F(ResultFileTest, MeasuresAPartWithAFailedCellAgainIfAskedTo)
{
    {
        ResultFile file({path_, "--out", {}}, false, Resuming{}, "");
        file.begin(fake_run());
        add_failed(file, 1);
    }
    EXPECT_TRUE(
        ResultFile(resumed(path_), false, Resuming{.is_asked = true}, "").take_part("0123"));
    const Resuming retrying{.is_asked = true, .retries_failed = true};
    const fs::path good = folder_ / "good.json";
    leave_killed(good);
    ResultFile file(resumed(good), false, retrying, "");
    EXPECT_EQ(file.take_part("0123"), 1.5) << "it was measured";
    Json run = fake_run();
    run["id"] = "later";
    {
        ResultFile again(resumed(path_), false, retrying, "");
        EXPECT_FALSE(again.take_part("0123"));
        again.begin(run);
        add_failed(again, 2);
    }
    ResultFile next(resumed(path_), false, retrying, "later");
    EXPECT_EQ(next.take_part("0123"), 2) << "this run has tried it";
}

TEST_F(ResultFileTest, OfCellsThatWereNotMeasuredSaysWhy)
{
    ResultFile file({}, false, fake_run());
    Cell cell = fake_cell();
    cell.status = Cell::Status::skipped;
    cell.reason = "no such scene";
    file.add(cell);
    EXPECT_THROW(file.exit_code(), NothingMeasured);
    EXPECT_THROW(Output(folder_, "--out", {}), BadUsage);
}

TEST_F(ResultFileTest, LeavesAnOlderFileAloneUntilThereIsACell)
{
    Output(path_, "--out", {}).replace("older");
    {
        const ResultFile file({path_, "--out", {.force = true}}, true, fake_run());
    }
    EXPECT_EQ(text_of(path_), "older");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

}  // namespace
}  // namespace bvhbench
