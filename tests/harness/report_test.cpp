// SPDX-License-Identifier: MIT
#include "harness/report.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "harness/report_paper.h"
#include "harness/report_quality.h"
#include "harness/report_refit.h"
#include "harness/report_yardstick.h"
#include "harness/table.h"
#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

TEST(Table, LinesUpWordsLeftAndNumbersRightByCharacters)
{
    Table table({{"name", Table::Align::left}, {"ms"}});
    table.row({"a–b", "1"});
    table.row({"longer", "10"});
    table.row({"c"});
    EXPECT_EQ(table.text(),
              "name    ms\n"
              "a–b      1\n"
              "longer  10\n"
              "c\n");
}

TEST(Numbers, HaveThreeDigitsAndAUnit)
{
    EXPECT_EQ(duration_text(0), "0 ns");
    EXPECT_EQ(duration_text(950), "950 ns");
    EXPECT_EQ(duration_text(999.7), "1.00 us");
    EXPECT_EQ(duration_text(71230), "71.2 us");
    EXPECT_EQ(duration_text(1300000), "1.30 ms");
    EXPECT_EQ(bytes_text(6914400), "6.91 MB");
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(1234567), "1,234,567");
    EXPECT_EQ(grouped(-123456), "-123,456");
}

TEST(Statistics, LieBetweenNeighboursInProportion)
{
    EXPECT_EQ(quantile({}, 0.5), 0);
    EXPECT_EQ(quantile({3}, 0.9), 3);
    EXPECT_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
    const Spread spread = spread_of({0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100});
    EXPECT_EQ(spread.median, 50);
    EXPECT_EQ(spread.p10, 10);
    EXPECT_EQ(spread.p90, 90);
    EXPECT_EQ(spread.q1, 25);
    EXPECT_EQ(spread.q3, 75);
}

TEST(Padding, IsCountedAndPrintedAsInTable1)
{
    Cell cell = fake_cell("oibvh-single");
    EXPECT_EQ(padding_text(padding_percent(cell)), "3.1e-3");
    cell.builder.name = "perfect";
    cell.counters["nodes_count"] = 524287;
    EXPECT_EQ(padding_text(padding_percent(cell)), "45.05");
    EXPECT_EQ(padding_text(0), "0");
    EXPECT_EQ(padding_text(100.0 * 7 / 825337), "8.4e-4") << "cut as in the paper, not rounded";
    EXPECT_EQ(padding_text(100.0 * 10 / 2174947), "4.5e-4");
    EXPECT_EQ(padding_text(100.0 * 5 / 5759999), "8.6e-5");
    EXPECT_EQ(padding_text(0.01), "1.0e-2");
}

TEST(CellReport, PrintsStagesCountersAndVerdict)
{
    EXPECT_EQ(
        cell_report(fake_cell(), fake_run()),
        "oibvh-multi on bunny, 144,046 triangles\n"
        "stage      median      p10       q1      q3     p90  launches    bytes   GB/s  % of copy"
        "  queued  submitted\n"
        "hierarchy  100 us  92.0 us  95.0 us  105 us  108 us         2  50.0 MB  500.0     50.0 %\n"
        "3 samples; quartiles 10.0 % apart\n"
        "counters: nodes_count 288,100, scratch_bytes 0, tree_bytes 6,914,400\n"
        "verdict: agrees with oibvh-reference, tree 00000000000000ff\n");
}

TEST(CellReport, SaysWhyThereAreNoMoreSamplesAndLeavesOutThoseBesideDrift)
{
    Cell cell = fake_cell();
    cell.first = {.compile_ns = 2000, .run_ns = 3000000};
    cell.sampling = {.stopped = Stopped::noisy, .until = 0.02, .cold = true};
    cell.samples[0].drifted = true;  // the slowest, of 110 us
    cell.samples[1].stages[0].queued_ns = 4000;
    cell.samples[2].stages[0].queued_ns = 6000;
    cell.samples[1].stages[0].submitted_ns = cell.samples[2].stages[0].submitted_ns = 700;
    const std::string text = cell_report(cell, fake_run());
    EXPECT_NE(
        text.find("3 samples, caches emptied before each, 1 of them beside drift of the device "
                  "and left out here; quartiles 5.3 % apart and staying so, above 2.0 %\n"
                  "first run 3.00 ms on the host's clock, kernels compiled in 2.00 us\n"),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("hierarchy  95.0 us"), std::string::npos) << text;
    EXPECT_NE(text.find("5.00 us     700 ns\n"), std::string::npos) << text;
    // Where most are beside drift nothing is left out: measured, and marked.
    cell.samples[1].drifted = true;
    EXPECT_NE(cell_report(cell, fake_run()).find("hierarchy  100 us"), std::string::npos);
}

TEST(RunReport, WarnsOfWhatSpoilsTimes)
{
    RunFacts run = fake_run();
    EXPECT_EQ(run_report(run).find("warning"), std::string::npos);
    run.conditions.warnings = {"the host is on battery"};
    EXPECT_NE(run_report(run).find("warning: the host is on battery\n"), std::string::npos);
}

TEST(CellReport, SaysWhatIsMissingAndWhereTheLeavesAre)
{
    Cell cell = fake_cell();
    cell.left_out = {{"epo", "not asked for"}};
    cell.leaves_by_depth = {0, 1, 2, 4};
    EXPECT_NE(cell_report(cell, fake_run())
                  .find("no epo: not asked for\nlevels of leaves: 1–3, half by 3\nverdict: "),
              std::string::npos);
    EXPECT_EQ(depths_text({0, 3, 2, 1}), "1–3, half by 1");
    EXPECT_EQ(depths_text({0, 0, 7}), "2");
    EXPECT_EQ(depths_text({}), "");
}

TEST(QualityReport, IsThereIfEndPointOverlapIs)
{
    Cell cell = fake_cell();
    cell.builder.order = "hilbert30";
    cell.counters["sah_cost"] = 90;
    cell.leaves_by_depth = {0, 0, 4};
    EXPECT_EQ(quality_report({fake_run(), {cell}}), "");
    cell.counters["epo"] = 12.345;
    EXPECT_EQ(quality_report({fake_run(), {cell}}),
              "scene  builder                   SAH    EPO  sibling overlap  levels of leaves\n"
              "bunny  oibvh-multi, hilbert30  90.00  12.35                   2\n");
}

TEST(CellsReport, NeverPrintsATimeOfAWrongTree)
{
    Cell wrong = fake_cell("oibvh-single");
    wrong.check.verdict = Check::Verdict::differs;
    wrong.check.detail = "node 3 is lost";
    Cell failed = fake_cell("perfect");
    failed.status = Cell::Status::failed;
    failed.reason = "out of memory";
    const Document document{fake_run(), {fake_cell(), wrong, failed}};
    EXPECT_EQ(
        cells_report(document),
        "scene  triangles  builder        median      p10       q1      q3     p90  n  Mtris/s"
        "  ns/tri   GB/s  % of copy  verdict\n"
        "bunny    144,046  oibvh-multi    100 us  92.0 us  95.0 us  105 us  108 us  3   1440.5"
        "    0.69  500.0     50.0 %  agrees\n"
        "bunny    144,046  oibvh-single  differs                                              "
        "                            node 3 is lost\n"
        "bunny    144,046  perfect        failed                                              "
        "                            out of memory\n"
        "3 cells, 1 agree\n");
    EXPECT_EQ(cell_report(wrong, fake_run()).find("us"), std::string::npos);
    EXPECT_EQ(cells_report({fake_run(), {fake_cell()}}, Lines::notable), "1 cells, 1 agree\n");
}

TEST(CellsReport, LeavesFramesToTheirOwnTableUnlessTheyAreWrong)
{
    Document mixed{fake_run(), {fake_cell(), fake_cell()}};
    mixed.cells.back().operation = Operation::collide;
    const std::string builds = cells_report(mixed, Lines::of_builds);
    EXPECT_EQ(std::count(builds.begin(), builds.end(), '\n'), 3)
        << builds;  // titles, the build and the sum
    mixed.cells.back().check.verdict = Check::Verdict::differs;
    const std::string wrong = cells_report(mixed, Lines::of_builds);
    EXPECT_EQ(std::count(wrong.begin(), wrong.end(), '\n'), 4) << wrong;
}

TEST(YardstickReport, HoldsKernelsToThreadsOfTheHostWhereTreesAreEqual)
{
    Cell other = fake_cell("karras", 400000);
    other.check.tree_hash = 0x7fu;
    Cell wrong = fake_cell("oibvh-single", 900000);
    wrong.check.verdict = Check::Verdict::differs;
    const Document document{
        fake_run(), {fake_cell("oibvh-multi", 125000), fake_cell("oibvh-host"), other, wrong}};
    EXPECT_EQ(
        yardstick_report(document),
        "scene  triangles  builder      hierarchy  oibvh-host  times\n"
        "bunny    144,046  oibvh-multi     125 us      100 us   1.25\n"
        "medians of the stage hierarchy, of trees that are equal: at most 1.25 times as long as "
        "by threads of the host\n");
    EXPECT_EQ(yardstick_report({fake_run(), {fake_cell("oibvh-multi")}}), "");
}

TEST(Table1Report, StandsBesideThePaperAndMarksStandIns)
{
    Cell stand_in = fake_cell("oibvh-single");
    stand_in.scene.stand_in_for = "bunny";
    stand_in.scene.name = "torus:144046";
    const std::string text = table1_report({fake_run(), {fake_cell(), stand_in}});
    EXPECT_EQ(text,
              "mesh     triangles  builder         nodes  padding %   paper      ms        p10–p90"
              "  Mtris/s    moved  % of copy  paper ms\n"
              "bunny      144,046  oibvh-multi   288,100     3.1e-3  3.1e-3  0.1000  0.0920–0.1080"
              "     1440  50.0 MB     50.0 %     0.077\n"
              "bunny *    144,046  oibvh-single  288,100     3.1e-3  3.1e-3  0.1000  0.0920–0.1080"
              "     1440  50.0 MB     50.0 %     0.074\n"
              "ms: the stage hierarchy from sorted leaves, median; paper ms: NVIDIA GeForce GTX "
              "1080\n"
              "* a generated stand-in with the mesh's triangle count: the mesh itself is not "
              "there\n");
}

Cell at_size(const char* builder, std::int64_t triangles, std::int64_t ns)
{
    Cell cell = fake_cell(builder, ns);
    cell.scene.triangles = triangles;
    return cell;
}

TEST(Fig8Report, FindsTheSizeFromWhichMultiStaysAhead)
{
    Document document{fake_run(), {}};
    const std::int64_t single[] = {20000, 30000, 50000, 80000};
    const std::int64_t multi[] = {25000, 29000, 51000, 70000};
    for (std::int64_t i = 0; i < 4; ++i) {
        document.cells.push_back(at_size("oibvh-single", 1024 << i, single[i]));
        document.cells.push_back(at_size("oibvh-multi", 1024 << i, multi[i]));
    }
    EXPECT_EQ(crossing_triangles(document), 8192);
    document.cells.resize(2);
    EXPECT_EQ(crossing_triangles(document), std::nullopt);
}

TEST(RefitReport, PutsARebuildBesideARefitOfTheSameBuilder)
{
    Cell rebuild = fake_cell("karras", 300000);
    rebuild.counters["sah_cost"] = 50;
    for (Sample& sample : rebuild.samples)
        sample.stages.push_back(fake_stage("sort", 100000, 0));
    Cell refit = fake_cell("karras", 200000);
    refit.counters["sah_cost"] = 51.5;
    refit.operation = Operation::refit;
    for (Sample& sample : refit.samples)
        sample.stages[0].stage = "refit";
    Cell other = refit;  // has no rebuild beside it
    other.builder.order = "morton63";
    Cell wrong = refit;
    wrong.check.verdict = Check::Verdict::differs;
    EXPECT_EQ(refit_report({fake_run(), {rebuild, other, wrong, refit}}),
              "scene  triangles  builder  rebuild   refit  times  hierarchy  refit stage  times  "
              "SAH rebuilt  refitted\n"
              "bunny    144,046  karras    400 us  200 us   2.00     300 us       200 us   1.50  "
              "      50.00     51.50\n"
              "medians; rebuild and refit: from moved triangles to a tree over them, all stages; "
              "times: rebuild over refit\n"
              "rebuilding takes longer than refitting in 1 of 1 cases\n");
    EXPECT_EQ(refit_report({fake_run(), {rebuild, other, wrong}}), "");
    EXPECT_TRUE(cell_report(refit, fake_run()).starts_with("karras, refit on bunny"));
}

Cell with_cost(const char* builder, double cost, const char* scene = "happy_buddha_1087716")
{
    Cell cell = fake_cell(builder);
    cell.scene.name = scene;
    cell.counters["sah_cost"] = cost;
    return cell;
}

TEST(Table4Report, StandsBesideThePaperAndSaysWhatIsMissing)
{
    Cell absent = with_cost("apetrei-fused", 0, "bunny");
    absent.status = Cell::Status::skipped;
    absent.reason = "no such builder";
    const Document document{
        fake_run(),
        {with_cost("apetrei-fused", 86.02), with_cost("oibvh-multi", 228.01),
         with_cost("oibvh-single", 228.01), absent, with_cost("oibvh-multi", 100, "bunny")}};
    EXPECT_EQ(table4_report(document),
              "mesh                    triangles  order     radix  paper  Oi-BVH   paper  times  "
              "paper\n"
              "happy_buddha_1087716 +    144,046  morton30  86.02  86.00  228.01  229.16   2.65   "
              "2.66\n"
              "bunny                     144,046  morton30                100.00                "
              "        skipped: no such builder\n"
              "surface area cost, an inner node 1.2, a triangle 1\n"
              "+ another edition of the paper's model, with another triangle count\n");
}

TEST(Table4Report, DoesNotCompareCostsOfOtherConstants)
{
    Document document{fake_run(),
                      {with_cost("apetrei-fused", 86.02), with_cost("oibvh-multi", 228.01)}};
    document.run.costs.inner = 2.5;
    const std::string text = table4_report(document);
    EXPECT_EQ(text.find("86.00"), std::string::npos) << text;
    EXPECT_NE(text.find("an inner node 2.5, a triangle 1; the paper's are for others\n"),
              std::string::npos)
        << text;
    EXPECT_NE(run_report(document.run).find("costs in sah_cost and epo: an inner node 2.5, "),
              std::string::npos);
}

TEST(Fig13Report, SaysWhichTreeSuffersMore)
{
    Document document{fake_run(), {}};
    for (const double diameters : {0.0, 10.0})
        for (const char* builder : {"karras", "oibvh-single"}) {
            document.cells.push_back(with_cost(builder, *builder == 'k' ? 10 : 20 + 5 * diameters));
            document.cells.back().scene.name = "outlier:bunny:0:" + std::to_string(diameters);
            document.cells.back().scene.outlier = {"bunny", 0, diameters};
        }
    const std::string text = fig13_report(document);
    EXPECT_NE(text.find("bunny  morton30         0       10.0  10.00   70.00   7.00\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("relative to the radix tree's grows, from 2.00 to 7.00 times"),
              std::string::npos)
        << text;
}

}  // namespace
}  // namespace bvhbench
