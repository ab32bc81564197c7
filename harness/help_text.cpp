// SPDX-License-Identifier: MIT
#include "harness/help.h"

namespace bvhbench {
namespace {

constexpr std::string_view measuring = "Measure";
constexpr std::string_view looking = "Look at results";
constexpr std::string_view holding = "Hold to promises";
constexpr std::string_view knowing = "Know what there is";

// A line of text stays a line.
// clang-format off
const std::vector<CommandHelp> helps = {
    {"list",
     knowing,
     "Names are what other commands take. A line that says 'built without' names a library that this build lacks.",
     {{"bvhbench list builders", "names, and what each is"},
      {"bvhbench list devices", "for --device: words of a name, or its index"},
      {"bvhbench list scenes", "generators and data sets, and which of those are there"}},
     "docs/adding.md"},
    {"build",
     measuring,
     "The tree is held to the builder's oracle, bit for bit, before samples count. Times are of stages on the device's clock, "
     "from first start to last end. The table tells median, percentiles, and the share of the device's copy rate that a "
     "stage reaches.",
     {{"bvhbench build --builder oibvh-multi --scene torus:100000", "a generated scene of 100,000 triangles"},
      {"bvhbench build --builder karras --scene bunny.ply --json karras.json", "a mesh file, samples kept"},
      {"bvhbench build --builder oibvh-multi --scene bunny --until 2% --cold", "until steady, from empty caches"}},
     "docs/measuring.md"},
    {"collide",
     measuring,
     "A frame is timed whole: vertices to tree to pairs, and with --narrow exact to triangles that intersect. Each frame's "
     "pairs are compared with an oracle's. Buffers that overflow are grown and the frame is done again; the "
     "table says so.",
     {{"bvhbench collide --collider leaf --scene bunny.obj --pairs pairs.csv", "a mesh with itself"},
      {"bvhbench collide --collider group --scene cloth-ball:20000 --frames 0: --adjacent drop --narrow exact",
       "an animation, to exact contacts"},
      {"bvhbench collide --collider bvtt --scene n-body:61000 --frames 0:4 --pairs-of between --skips",
       "between objects, and what leaving work out saves"},
      {"bvhbench collide --collider block --scene cloth-ball:20000:20 --swept", "what may meet between frames"}},
     "docs/collisions.md"},
    {"run",
     measuring,
     "An experiment is a list of scenes, builders, colliders and samples, as JSON; some are in the program. Builders "
     "of a scene are sampled in turn. What is finished is in the result file at once.",
     {{"bvhbench run peers --out peers.json", "an experiment of `list experiments`"},
      {"bvhbench run mine.json --filter bunny/oibvh --samples 50", "one of your own, and part of it"},
      {"bvhbench run smoke --turns turns:2 --out a.json", "by turns with a second run of another build"}},
     "docs/adding.md"},
    {"sweep",
     measuring,
     "Each cell, or scene, has a process of its own, so a crash costs one cell. The same command again goes on where it "
     "was interrupted. The folder has sweep.json, a result file like any other, once cells are there.",
     {{"bvhbench sweep --scenes torus --sizes 1000:1000000:x10 --builders oibvh-multi,karras --out out/sizes",
       "eight cells"},
      {"bvhbench sweep docs/sweep.json --shard 2/8 --out out/part-2", "the second of eight machines"},
      {"bvhbench sweep docs/sweep.json --out out/all --dry-run", "which cells, and how many"}},
     "docs/sweeps.md"},
    {"reproduce",
     measuring,
     "Writes result file and figure into --out, and prints our numbers beside the paper's. `all` goes through all "
     "of them and makes report.html, one page of everything. Meshes that are not there are "
     "replaced by generated ones of as many triangles; table, figure and file say so.",
     {{"bvhbench reproduce table1", "construction times, out/table1.json and pictures"},
      {"bvhbench reproduce all --quick", "every table and figure, small, and out/report.html"},
      {"bvhbench reproduce fig8 --device nvidia --data meshes", "on a GPU, with real meshes"}},
     "docs/paper.md"},
    {"accuracy",
     measuring,
     "Errors are counted against exact arithmetic on the stored coordinates: so many missed, so many false, of so many.",
     {{"bvhbench accuracy --axis narrow --pairs 1000000", "narrow phases: how often is each wrong, and how fast?"},
      {"bvhbench accuracy --axis boxes --scene bunny --out out/boxes", "boxes in fewer bits"}},
     "docs/accuracy.md"},
    {"tune",
     measuring,
     "No value changes what is built or found, and each answer is checked. Later runs read the file from --tuning.",
     {{"bvhbench tune sort --scene torus:144046", "the sort alone"},
      {"bvhbench tune --scene bunny --device nvidia --out tuning/mine.json", "all in turn"}},
     "docs/tuning.md"},
    {"show",
     looking,
     "Prints what the command that wrote the file did.",
     {{"bvhbench show peers.json", "its tables"}},
     "docs/results.md"},
    {"compare",
     looking,
     "Times by an interval of the ratio of medians and by the Mann-Whitney test: SAME, FASTER, SLOWER or UNSURE. Verdicts, "
     "counters and errors exactly. 1 if anything is slower, larger or wrong, so that CI can gate on it.",
     {{"bvhbench compare before.json after.json", "what got worse?"},
      {"bvhbench compare before.json after.json --threshold 10% --all", "coarser, and every cell"}},
     "docs/comparing.md"},
    {"plot",
     looking,
     "Finds out which figures the cells of a file can make. PNG and SVG; equal numbers give equal bytes.",
     {{"bvhbench plot out/sizes/sweep.json", "beside where you are"},
      {"bvhbench plot results --out pictures", "of every file below a folder"}},
     "docs/sweeps.md"},
    {"report",
     looking,
     "The page needs no network and no server: tables to sort and filter, charts, and behind each number its samples. "
     "1 if an answer in a file was wrong, which the page shows.",
     {{"bvhbench report peers.json -o report.html", "one file"},
      {"bvhbench report a.json b.json --scene torus:3000 -o report.html", "two, and a scene in three dimensions"}},
     "docs/report.md"},
    {"merge",
     looking,
     "Of shards of a sweep, or of runs of parts. Refuses a cell that two files tell differently.",
     {{"bvhbench merge out/part-1/sweep.json out/part-2/sweep.json -o sweep.json", "two shards"}},
     "docs/sweeps.md"},
    {"check",
     holding,
     "Every promise of builders/builder.h, over inputs that are hard on builders.",
     {{"bvhbench check", "all builders"}, {"bvhbench check --builder oibvh-single --scene bunny", "one, over a scene"},
      {"bvhbench check --portable --device 1", "what works on a device that nobody has tried"}},
     "docs/reliability.md"},
    {"smoke",
     holding,
     "Every builder and collider, under a minute on two cores. 1 and a line for whatever is not as the baseline says.",
     {{"bvhbench smoke", "is all as before?"},
      {"bvhbench smoke --update", "a change was meant: the baseline goes along in the commit"}},
     "docs/ci.md"},
    {"stress",
     holding,
     "1 if one of ours is wrong, whatever libraries do.",
     {{"bvhbench stress --quick", "minutes"},
      {"bvhbench stress --seed 7 --out stress.json", "all, and a file for plots/stress.py"},
      {"bvhbench stress --filter ^scale/.*/front", "cells whose family/scene/system this matches"}},
     "docs/stress.md"},
};

}  // namespace

std::span<const CommandHelp> command_helps() { return helps; }

}  // namespace bvhbench
