// SPDX-License-Identifier: MIT
//
// The command line, understood: what main hands on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "harness/catalog.h"
#include "harness/collider_catalog.h"
#include "harness/node_costs.h"
#include "harness/sampling.h"

namespace bvhbench {

struct CommonOptions {
    std::string device;   ///< words or an index; empty: the first CPU, else the first device
    std::string kernels;  ///< a source tree to read kernels from; empty: those in the program
    std::string data;     ///< the folder of data sets; empty: BVHBENCH_DATA
    std::string doubles =
        "recentred";  ///< what becomes of coordinates that floats cannot hold: doubles_name
    std::optional<std::string>
        tuning;  ///< the folder of tuned values; empty: none; not given: BVHBENCH_TUNING
    std::size_t memory_limit =
        0;  ///< bytes of this process in all, and of the device; 0: what there is
    double time_limit_s = 600;  ///< of a single build or query; 0: none
    bool force = false;         ///< whether earlier files are replaced
    bool verbose = false;
};

/// --help and --version: nothing to do but print.
struct PrintCommand {
    std::string text;
};
struct ListCommand {
    std::string
        what;  ///< builders, colliders, narrow, orders, formats, skips, tuning, scenes, devices, accuracy or experiments
};
struct BuildCommand {
    BuilderChoice builder;
    std::string scene;
    int samples = 20;
    SamplingWords sampling;
    std::string json;  ///< result file to write; may be empty
    std::string dump;  ///< file for the spelled-out tree; may be empty
    bool quality = false;
    NodeCosts costs;
};
struct CollideCommand {
    BuilderChoice builder;
    ColliderChoice collider;
    std::vector<std::string> scenes;
    std::string objects = "auto";
    std::string frames = "0";
    unsigned between = 0;
    bool swept = false;  ///< boxes are around the way from each frame to the next
    int samples = 20;
    SamplingWords sampling;
    bool skips = false;    ///< whether each rule is measured switched off as well
    std::string json;      ///< result file to write; may be empty
    std::string pairs;     ///< file for the pairs of every frame, .csv or .bin; may be empty
    std::string contacts;  ///< file for the contacts; may be empty
};
struct RunCommand {
    std::string experiment;  ///< a name or a path
    std::string out;         ///< result file; empty: <experiment>.json
    std::string filter;      ///< regular expression on "scene/builder"
    int samples = 0;         ///< 0: as the experiment says
    SamplingWords sampling;
    std::string turns;  ///< file and number of runs that sample by turns; may be empty
    bool quick = false;
    bool quality = false;
    NodeCosts costs;
};
struct ReproduceCommand {
    std::string what;  ///< a name of reproducible()
    std::string out = "out";
    bool quick = false;
    bool quality = false;
    NodeCosts costs;
};
struct CheckCommand {
    std::string builder;    ///< empty: all
    std::string scene;      ///< empty: the hard inputs
    bool portable = false;  ///< instead: what a user of an untried device sends
};
struct ShowCommand {
    std::string file;
};
struct CompareCommand {
    std::string first, second;  ///< result files
    double threshold = 0.05;    ///< the smallest change of time that counts, as a share
    bool all = false;           ///< whether unchanged cells are in the table
    bool allow_missing = false;
    bool allow_dirty = false;
    bool other_devices = false;
    bool allow_test_hooks = false;
};
struct SmokeCommand {
    std::string
        baseline;        ///< file to hold the run to; empty: the device kind's in results/baseline
    std::string filter;  ///< regular expression on "scene/builder"
    std::string out;     ///< result file to write; may be empty
    double tolerance = 5;  ///< of times, as a ratio
    bool update = false;   ///< write the baseline
};
struct TuneCommand {
    std::string target;  ///< sort, a builder or a collider; empty: the usual ones
    std::string scene;
    BuilderChoice builder;    ///< of a collider's trees; its options are a builder's own too
    ColliderChoice collider;  ///< a collider's options
    std::string out;          ///< tuning file; empty: the device's
    int samples = 0;          ///< 0: as many as suit
    bool quick = false;
};

struct AccuracyCommand {
    std::string axis;                 ///< empty: all
    std::vector<std::string> scenes;  ///< empty: each axis's own
    std::size_t pairs = 1'000'000;
    unsigned seed = 1;
    std::string filter;  ///< regular expression on "input/method"
    int samples = 5;
    std::string out = "out";
};

struct StressCommand {
    bool quick = false;
    std::uint64_t seed = 1;
    std::string filter;  ///< regular expression on "family/scene/system"
    std::string out;     ///< result file to write; may be empty
};

struct SweepCommand {
    std::string file;  ///< the sweep as JSON; empty: the rest says it all
    std::string name;  ///< this and those up to `set` take the place of what is in the file
    std::vector<std::string> scenes, builders, orders, colliders;
    std::string sizes;              ///< "1000:1000000:x10"
    std::vector<std::string> set;   ///< "key=v1,v2"
    int samples = 0, warm_up = -1;  ///< 0 and -1: as the file says
    bool quality = false;
    NodeCosts costs;
    std::string out;  ///< the folder
    std::vector<std::string> devices;
    unsigned jobs = 0;  ///< 0: one a device
    std::string shard;  ///< "i/n"; empty: all
    std::string together = "cell";
    double cell_limit_s = 0;  ///< 0: none
    bool continue_other_commit = false;
    bool retry_failed = false;
    bool dry_run = false;
};

struct MergeCommand {
    std::vector<std::string> files;
    std::string out;
    bool other_devices = false;
    bool other_commits = false;
};

struct PlotCommand {
    std::vector<std::string> files;
    std::string out = "out";
};

struct ReportCommand {
    std::vector<std::string> files;  ///< result files
    std::string out = "report.html";
    std::vector<std::string> scenes;  ///< to show in three dimensions; a frame of each
    unsigned frame = 0;
    BuilderChoice builder{.name = "oibvh-multi"};
    ColliderChoice collider{.name = "leaf", .keep_adjacent = false, .narrow = "exact"};
};

using Command = std::variant<PrintCommand, ListCommand, BuildCommand, CollideCommand, RunCommand,
                             ReproduceCommand, CheckCommand, ShowCommand, TuneCommand,
                             AccuracyCommand, StressCommand, SweepCommand, MergeCommand,
                             PlotCommand, ReportCommand, CompareCommand, SmokeCommand>;

struct Options {
    CommonOptions common;
    Command command;
    std::vector<std::string> words;  ///< argv, for the result file
};

/// Throws BadUsage, in one sentence, for anything that is not understood.
Options parse_options(int argc, const char* const* argv);

}  // namespace bvhbench
