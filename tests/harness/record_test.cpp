// SPDX-License-Identifier: MIT
#include "harness/record/record.h"

#include <cstdlib>
#include <limits>

#include "harness/record/provenance.h"
#include "harness/session/tuning_file.h"
#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

TEST(Record, WritesACellOnOneLineWithKeysThatEndInTheirUnit)
{
    Cell cell = fake_cell();
    cell.samples.resize(1);
    EXPECT_EQ(
        cell_text(cell),
        R"({"experiment":"table1","scene":{"name":"bunny","triangles":144046,"vertices":72027,)"
        R"("objects":1,"frame":0,"source":"bunny.ply","content_hash":"00ab54a98ceb1f0a"},)"
        R"("builder":{"name":"oibvh-multi","options":{"order":"morton30","grid":"object","group_size":0,"items":0,)"
        R"("boxes":"f32","leaves":"mesh"}},"operation":"build","status":"measured","warm_up":1,"samples":[{"order":7,"stages":)"
        R"([{"stage":"hierarchy","launches":2,"busy_ns":109990,"span_ns":110000,)"
        R"("moved_bytes":50000000,"start_ns":0,"queued_ns":0,"submitted_ns":0}]}],"counters":{"nodes_count":288100,"scratch_bytes":0,)"
        R"("tree_bytes":6914400},"check":{"verdict":"agrees","against":"oibvh-reference",)"
        R"("tree_hash":"00000000000000ff"}})");
}

TEST(Record, KeepsAStageWithNothingToLaunchOnTheDevicesClock)
{
    Cell cell = fake_cell();
    cell.samples = {{0, {{"hierarchy", 0, 0, 0, 0, 0}}}};
    EXPECT_TRUE(contains(cell_text(cell), R"({"stage":"hierarchy","launches":0,"busy_ns":0,)"));
}

TEST(Record, SaysOnlyWhyForACellWithoutNumbers)
{
    Cell cell = fake_cell();
    cell.status = Cell::Status::failed;
    cell.reason = "out of device memory";
    const std::string text = cell_text(cell);
    EXPECT_TRUE(contains(text, R"("status":"failed","reason":"out of device memory"})"));
    EXPECT_EQ(text.find("samples"), std::string::npos);
}

TEST(Record, LeavesOutWhatIsNoNumber)
{
    Cell cell = fake_cell();
    cell.counters["broken_ratio"] = std::numeric_limits<double>::quiet_NaN();
    cell.counters["endless_ratio"] = std::numeric_limits<double>::infinity();
    EXPECT_EQ(cell_text(cell).find("_ratio"), std::string::npos);
    EXPECT_EQ(cell_text(cell).find("null"), std::string::npos);
}

TEST(Record, KeepsBytesThatAreNoUtf8OutOfTheFile)
{
    Cell cell = fake_cell();
    cell.scene.source = "a\xff.ply";
    EXPECT_FALSE(Json::parse(cell_text(cell), nullptr, false).is_discarded());
}

TEST(Record, TellsAllThatACellIsAbout)
{
    Cell cell = fake_cell("oibvh-reference");
    cell.builder = {
        {.order = "morton63", .grid = GridOver::scene, .sorted_leaves = true, .boxes = "u16"},
        "karras"};
    cell.operation = Operation::collide;
    cell.collider = {{.among = Among::between_objects,
                      .keep_adjacent = false,
                      .jump = 3,
                      .start_level = 2,
                      .group_size = 64},
                     "leaf",
                     "exact"};
    cell.scene.outlier = {"bunny", 3, 2.5};
    cell.scene.bend_of = "bunny";
    cell.scene.rounding = {Doubles::recentred, {4500123.45, -2, 0.1}, -3, 17, 1.25e-7};
    cell.scene.objects_by = "components";
    cell.scene.between = 3;
    cell.features = {"edge-edge", 5, 900};
    cell.accuracy = {"narrow", "guigue-f64", 7};
    cell.left_out = {{"epo", "not asked for"}};
    cell.leaves_by_depth = {0, 1, 2};
    cell.check = {Check::Verdict::counted, "brute", "3 false", {}, 0x34u, 0x56u};
    cell.first_contact = {3, 5};
    cell.within_distance = 0.1;
    cell.first = {.compile_ns = 12, .run_ns = 34};
    cell.sampling = {.stopped = Stopped::noisy, .until = 0.02, .caches = Caches::cold};
    cell.samples = {{3, {{"hierarchy", 0, 0, 1234, 0, 0}}, 99, true}};
    const Json json = Json::parse(cell_text(cell));
    const auto at = [&](const char* pointer) { return json.at(Json::json_pointer(pointer)); };
    EXPECT_EQ(at("/builder/options/grid"), "scene");
    EXPECT_EQ(at("/builder/options/boxes"), "u16");
    EXPECT_EQ(at("/collider"),
              Json::parse(R"({"name": "leaf", "options": {"pairs_of": "between", "adjacent": "drop",
        "narrow": "exact", "first": false, "within": "none", "separation": "none", "no_skip": "", "force_skip": "", "update": "auto", "trees": "object", "jump": 3, "start_level": 2, "group_size": 64}})"));
    EXPECT_EQ(at("/scene/outlier/diameters"), 2.5);
    EXPECT_EQ(at("/scene/doubles/offset/0"), 4500123.45);
    EXPECT_EQ(at("/scene/objects_by"), "components");
    EXPECT_EQ(at("/scene/between"), 3);
    EXPECT_EQ(at("/swept/to_frame"), 5);
    EXPECT_EQ(at("/accuracy/seed"), 7);
    EXPECT_EQ(at("/left_out/epo"), "not asked for");
    EXPECT_EQ(at("/leaves_by_depth"), Json({0, 1, 2}));
    EXPECT_EQ(at("/first_contact"), Json({3, 5}));
    EXPECT_EQ(at("/within_distance"), 0.1);
    EXPECT_EQ(at("/check/verdict"), "counted");
    EXPECT_EQ(at("/check/contacts_hash"), "0000000000000056");
    EXPECT_EQ(at("/first/run_ns"), 34);
    EXPECT_EQ(at("/sampling"), Json({{"stopped", "noisy"}, {"caches", "cold"}, {"until", 0.02}}));
    EXPECT_EQ(at("/samples/0/stages/0/wall_ns"), 1234);
    EXPECT_EQ(at("/samples/0/drifted"), true);
}

TEST(Record, TellsTheCircumstancesOfARun)
{
    Device device = open_device("");
    device.tuning = Tuning("results/tuning/a-device.json");
    device.tuning.set(*tuning_parameters().front(), 7);
    setenv("BVHBENCH_SLOW", "karras:2", 1);
    const Json run = run_facts(device, {"/somewhere/bvhbench", "a\xff"}, {2, 0.5});
    unsetenv("BVHBENCH_SLOW");
    EXPECT_EQ(run["command"][0], "bvhbench");
    EXPECT_EQ(run["device"]["name"], device.name());
    EXPECT_GT(run["device"]["compute_units"], 0);
    EXPECT_EQ(run["node_costs"], Json({{"inner", 2.0}, {"triangle", 0.5}}));
    EXPECT_EQ(run["tuning"]["from"], "results/tuning/a-device.json");
    EXPECT_EQ(run["tuning"]["values"], Json({{std::string(tuning_parameters().front()->name), 7}}));
    EXPECT_TRUE(run["conditions"]["warnings"].is_array());
    EXPECT_EQ(run["test_hooks"]["BVHBENCH_SLOW"], "karras:2");
    EXPECT_FALSE(Json::parse(one_line(run), nullptr, false).is_discarded());
    EXPECT_EQ(run_facts(open_device(""), {})["tuning"],
              Json({{"from", "none"}, {"values", Json::object()}}));
}

TEST(Record, TellsWhatStressFound)
{
    StressCell cell;
    cell.family = "scale", cell.scene = "1e20", cell.triangles = 300;
    cell.system = "rtcCollide", cell.kind = StressCell::Kind::library, cell.library = "Embree";
    cell.findings = {{Invariant::ends, {Finding::Verdict::holds, 1}},
                     {Invariant::pairs, {Finding::Verdict::broken, 747, 748, 747, "747 missed"}}};
    const Json json = Json::parse(cell_text(cell));
    EXPECT_EQ(json["kind"], "library");
    EXPECT_EQ(json["findings"]["pairs"], Json({{"verdict", "broken"},
                                               {"checked", 747},
                                               {"wrong", 748},
                                               {"missed", 747},
                                               {"detail", "747 missed"}}));
}

}  // namespace
}  // namespace bvhbench
