// SPDX-License-Identifier: MIT
#include "harness/record.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/error.h"
#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

std::string text_of(const RunFacts& run, const std::vector<Cell>& cells)
{
    std::vector<std::string> texts;
    for (const Cell& cell : cells)
        texts.push_back(cell_text(cell));
    return document_text(run_text(run), texts);
}

TEST(Record, WritesACellOnOneLineWithKeysThatEndInTheirUnit)
{
    Cell cell = fake_cell();
    cell.samples.resize(1);
    EXPECT_EQ(
        cell_text(cell),
        R"({"experiment":"table1","scene":{"name":"bunny","triangles":144046,"vertices":72027,)"
        R"("objects":1,"frame":0,"source":"bunny.ply","content_hash":"00ab54a98ceb1f0a"},)"
        R"("builder":{"name":"oibvh-multi","options":{"order":"morton30","group_size":0,"items":0,)"
        R"("leaves":"mesh","boxes":"f32"}},"operation":"build","status":"measured","warm_up":1,"samples":[{"order":7,"stages":)"
        R"([{"stage":"hierarchy","launches":2,"busy_ns":109990,"span_ns":110000,)"
        R"("moved_bytes":50000000,"start_ns":0,"queued_ns":0,"submitted_ns":0}]}],"counters":{"nodes_count":288100,"scratch_bytes":0,)"
        R"("tree_bytes":6914400},"check":{"verdict":"agrees","against":"oibvh-reference",)"
        R"("tree_hash":"00000000000000ff"}})");
}

TEST(Record, KeepsAStageWithNothingToLaunchOnTheDevicesClock)
{
    Cell cell = fake_cell();
    cell.samples = {{0, {{"hierarchy", 0, 0, 0, 0, 0}}}};
    EXPECT_NE(cell_text(cell).find(R"({"stage":"hierarchy","launches":0,"busy_ns":0,)"),
              std::string::npos);
}

TEST(Record, SaysOnlyWhyForACellWithoutNumbers)
{
    Cell cell = fake_cell();
    cell.status = Cell::Status::failed;
    cell.reason = "out of device memory";
    const std::string text = cell_text(cell);
    EXPECT_NE(text.find(R"("status":"failed","reason":"out of device memory"})"),
              std::string::npos);
    EXPECT_EQ(text.find("samples"), std::string::npos);
}

TEST(Record, LeavesOutWhatIsNoNumber)
{
    Cell cell = fake_cell();
    cell.counters["broken_ratio"] = std::numeric_limits<double>::quiet_NaN();
    cell.counters["endless_ratio"] = std::numeric_limits<double>::infinity();
    EXPECT_EQ(cell_text(cell).find("_ratio"), std::string::npos);
    EXPECT_EQ(cell_text(cell).find("null"), std::string::npos);

    RunFacts run = fake_run();
    run.copy_rate_bytes_per_s = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(run_text(run).find("copy_rate"), std::string::npos);
}

TEST(Record, KeepsBytesThatAreNoUtf8OutOfTheFile)
{
    Cell cell = fake_cell();
    cell.scene.source = "a\xff.ply";
    EXPECT_NO_THROW(read_document(text_of(fake_run(), {cell}), "x"));
}

TEST(Record, ReadsBackWhatItWrote)
{
    Cell failed = fake_cell("perfect");
    failed.status = Cell::Status::skipped;
    failed.reason = "built without it";
    Cell host = fake_cell("oibvh-reference");
    host.builder.sorted_leaves = true;
    host.builder.boxes = "u16";
    host.builder.order = "morton63";
    host.samples = {{3, {{"hierarchy", 0, 0, 1234, 0, 0}}}};
    host.check = {Check::Verdict::differs, "oibvh-reference", "something", 0x12u};
    host.scene.outlier = {"bunny", 3, 2.5};
    host.scene.bend_of = "bunny";
    host.scene.rounding = {Doubles::recentred, {4500123.45, -2, 0.1}, -3, 17, 1.25e-7};
    host.builder.grid = GridOver::scene;
    host.operation = Operation::refit;
    host.left_out = {{"epo", "not asked for"}};
    host.leaves_by_depth = {0, 1, 2};
    RunFacts run = fake_run();
    run.costs = {.inner = 2, .triangle = 0.5};
    Cell query = fake_cell();
    query.operation = Operation::collide;
    query.collider = {"leaf", Among::between_objects, false, "exact", 3, 2, 64};
    query.check = {Check::Verdict::agrees, "brute", "", {}, 0x34u, 0x56u};
    Cell axis = fake_cell();
    axis.operation = Operation::accuracy;
    axis.accuracy = {"narrow", "guigue-f64", 7};
    axis.check.verdict = Check::Verdict::counted;
    query.swept = {"edge-edge", 5, 900};
    query.scene.objects_by = "components";
    query.scene.between = 3;
    const std::string text = text_of(run, {fake_cell(), failed, host, query, axis});

    const Document document = read_document(text, "x");
    EXPECT_EQ(text_of(document.run, document.cells), text);
    EXPECT_EQ(document.run.costs, (NodeCosts{2, 0.5}));
    EXPECT_EQ(document.cells[2].scene.outlier.diameters, 2.5);
    EXPECT_EQ(document.cells[2].scene.bend_of, "bunny");
    EXPECT_EQ(document.cells[2].scene.rounding.how, Doubles::recentred);
    EXPECT_EQ(document.cells[2].scene.rounding.offset.x, 4500123.45);
    EXPECT_EQ(document.cells[2].builder.grid, GridOver::scene);
    EXPECT_FALSE(document.cells[0].scene.rounding.how);
    EXPECT_EQ(document.cells[2].operation, Operation::refit);
    EXPECT_EQ(document.cells[2].left_out, host.left_out);
    EXPECT_EQ(document.cells[2].leaves_by_depth, host.leaves_by_depth);
    EXPECT_EQ(document.cells[3].swept.pairs, "edge-edge");
    EXPECT_EQ(document.cells[3].swept.to_frame, 5);
    EXPECT_EQ(document.cells[3].swept.primitives, 900);
    EXPECT_EQ(document.cells[4].operation, Operation::accuracy);
    EXPECT_EQ(document.cells[4].accuracy.method, "guigue-f64");
    EXPECT_EQ(document.cells[4].accuracy.seed, 7);
    EXPECT_EQ(document.cells[4].check.verdict, Check::Verdict::counted);
    EXPECT_EQ(document.cells[3].operation, Operation::collide);
    EXPECT_EQ(document.cells[3].collider, query.collider);
    EXPECT_EQ(document.cells[3].check.pairs_hash, 0x34u);
    EXPECT_EQ(document.cells[3].check.contacts_hash, 0x56u);
    EXPECT_EQ(document.cells[2].samples[0].stages[0].elapsed_ns(), 1234);
}

TEST(Record, ReadsBackHowSamplesWereTaken)
{
    Cell cell = fake_cell();
    cell.first = {.compile_ns = 12, .run_ns = 34};
    cell.sampling = {.stopped = Stopped::noisy, .until = 0.02, .cold = true};
    cell.samples[0].calibration_ns = 1234;
    cell.samples[1].drifted = true;
    cell.samples[0].stages[0].queued_ns = 5;
    cell.samples[0].stages[0].submitted_ns = 6;
    RunFacts run = fake_run();
    run.conditions = {.governor = "powersave",
                      .turbo = true,
                      .on_battery = false,
                      .load = 0.5,
                      .warnings = {"slow"}};
    run.test_hooks = {{"BVHBENCH_SLOW", "karras:2"}};
    const std::string text = text_of(run, {cell});
    const Document document = read_document(text, "x");
    EXPECT_EQ(text_of(document.run, document.cells), text);
    EXPECT_EQ(document.minor, newest_minor);
    EXPECT_EQ(document.run.conditions, run.conditions);
    EXPECT_EQ(document.run.test_hooks, run.test_hooks);
    const Cell& read = document.cells[0];
    EXPECT_EQ(read.first.compile_ns, 12);
    EXPECT_EQ(read.first.run_ns, 34);
    EXPECT_EQ(read.sampling.stopped, Stopped::noisy);
    EXPECT_EQ(read.sampling.until, 0.02);
    EXPECT_TRUE(read.sampling.cold);
    EXPECT_EQ(read.samples[0].calibration_ns, 1234);
    EXPECT_FALSE(read.samples[0].drifted);
    EXPECT_TRUE(read.samples[1].drifted);
    EXPECT_EQ(read.samples[0].stages[0].queued_ns, 5);
    EXPECT_EQ(read.samples[0].stages[0].submitted_ns, 6);
}

TEST(Record, ReadsBackWhatALaunchCostsAndWhatTheDeviceWasTunedTo)
{
    RunFacts run = fake_run();
    run.launch_cost_ns = 3812.5;
    run.tuning_from = "results/tuning/a-device.json";
    run.tuning = {{"sort.keys_per_item", 7}, {"walk.task_leaves", 32}};
    const RunFacts read = read_document(document_text(run_text(run), {}), "test").run;
    EXPECT_EQ(read.launch_cost_ns, 3812.5);
    EXPECT_EQ(read.tuning_from, run.tuning_from);
    EXPECT_EQ(read.tuning, run.tuning);
    EXPECT_EQ(read_document(document_text(run_text(fake_run()), {}), "test").run.tuning_from,
              "none");
}

TEST(Record, ReadsBackWhatStressFound)
{
    StressCell cell;
    cell.family = "scale", cell.scene = "1e20", cell.triangles = 300;
    cell.system = "rtcCollide", cell.kind = StressCell::Kind::library, cell.library = "Embree";
    cell.findings = {{Invariant::ends, {Finding::Verdict::holds, 1}},
                     {Invariant::pairs, {Finding::Verdict::broken, 747, 748, 747, "747 missed"}}};
    StressCell ours;
    ours.family = "layout", ours.scene = "all", ours.system = "layout.h",
    ours.kind = StressCell::Kind::host;
    ours.findings = {{Invariant::layout, {Finding::Verdict::refused, 0, 0, 0, "none"}}};
    const std::string text =
        document_text(run_text(fake_run()), {}, {cell_text(cell), cell_text(ours)});
    EXPECT_EQ(read_document(text, "a").stress, (std::vector{cell, ours}));
    EXPECT_TRUE(read_document(document_text(run_text(fake_run()), {}), "a").stress.empty());
    std::string other = text;
    other.replace(other.find("layout\":{"), 6, "colour");
    EXPECT_THROW(read_document(other, "a"), Unavailable);
}

TEST(Record, TakesACellThatDoesNotSayForABuild)
{
    std::string text = text_of(fake_run(), {fake_cell()});
    const std::string said = R"("operation":"build",)";
    text.erase(text.find(said), said.size());
    EXPECT_EQ(read_document(text, "x").cells[0].operation, Operation::build);
    text = text_of(fake_run(), {fake_cell()});
    text.replace(text.find(said), said.size(), R"("operation":"paint",)");
    EXPECT_THROW(read_document(text, "x"), Unavailable);
}

TEST(Record, RefusesWhatIsNoResultFileOfThisFormat)
{
    EXPECT_THROW(read_document("{", "x"), Unavailable);
    EXPECT_THROW(read_document("[]", "x"), Unavailable);
    EXPECT_THROW(read_document(R"({"format": "2.0", "run": {}, "cells": []})", "x"), Unavailable);
    EXPECT_THROW(read_document(R"({"format": "1.0", "run": {}, "cells": []})", "x"), Unavailable);
    std::string text = text_of(fake_run(), {fake_cell()});
    text.replace(text.find("measured"), 8, "guessed!");
    EXPECT_THROW(read_document(text, "x"), Unavailable);
}

}  // namespace
}  // namespace bvhbench
