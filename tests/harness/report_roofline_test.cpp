// SPDX-License-Identifier: MIT
#include "harness/report_roofline.h"

#include <gtest/gtest.h>

#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

/// 1e12 bytes a second, 4 microseconds a launch; a hierarchy of 2 launches, 5e7 bytes and 100 microseconds.
Document fake_document()
{
    Document document{fake_run(), {}};
    document.cells.push_back(fake_cell());
    document.run.launch_cost_ns = 4000;
    document.cells.front().experiment = "roofline";
    return document;
}

Cell fake_frame(const char* builder)
{
    Cell cell = fake_cell(builder);
    cell.experiment = "roofline";
    cell.operation = Operation::collide;
    cell.collider.name = "leaf";
    for (Sample& sample : cell.samples)
        sample.stages.push_back(fake_stage("broad", 600, 7));
    return cell;
}

TEST(Floor, IsBytesAtTheCopyRateAndLaunchesAtTheirCost)
{
    const std::vector<Floor> floors = floors_of(fake_document());
    ASSERT_EQ(floors.size(), 1u);
    EXPECT_DOUBLE_EQ(floors[0].floor_ns, 50000 + 2 * 4000);
    EXPECT_DOUBLE_EQ(floors[0].reached_ns, 100000);
    EXPECT_EQ(floors[0].stage, "hierarchy");
}

TEST(Floor, IsOfTheQueryAloneWhereFramesHaveATree)
{
    Document document = fake_document();
    document.cells.clear();
    for (const char* builder : {"oibvh-multi", "none"})
        document.cells.push_back(fake_frame(builder));
    std::vector<std::string> stages;
    for (const Floor& floor : floors_of(document))
        stages.push_back(floor.stage);
    EXPECT_EQ(stages, (std::vector<std::string>{"broad", "hierarchy", "broad"}));
}

TEST(Floor, ThereIsNoneOfWhatIsWrongOnTheHostOrWithoutBytes)
{
    Document document = fake_document();
    document.cells.resize(3, document.cells.front());
    document.cells[0].check.verdict = Check::Verdict::differs;
    for (Sample& sample : document.cells[1].samples)
        sample.stages = {{.stage = "hierarchy", .wall_ns = 100}};
    for (Sample& sample : document.cells[2].samples)
        sample.stages[0].moved_bytes = 0;
    EXPECT_TRUE(floors_of(document).empty());
    document = fake_document();
    document.run.copy_rate_bytes_per_s = 0;
    EXPECT_TRUE(floors_of(document).empty());
}

TEST(RooflineReport, PrintsTheRatioAndNothingOfOtherExperiments)
{
    Document document = fake_document();
    const std::string text = roofline_report(document);
    EXPECT_NE(text.find("bunny  oibvh-multi  hierarchy         2  50.0 MB       347.1  58.0 us   "
                        "100 us   1.72"),
              std::string::npos)
        << text;
    document.cells.front().experiment = "table1";
    EXPECT_EQ(roofline_report(document), "");
}

}  // namespace
}  // namespace bvhbench
