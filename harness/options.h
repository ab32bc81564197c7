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

namespace bvhbench {

struct CommonOptions {
    std::string device;   ///< words or an index; empty: the first CPU, else the first device
    std::string kernels;  ///< a source tree to read kernels from; empty: those in the program
    std::string data;     ///< the folder of data sets; empty: BVHBENCH_DATA
    std::string doubles =
        "recentred";  ///< what becomes of coordinates that floats cannot hold: doubles_name
    std::optional<std::string>
        tuning;  ///< the folder of tuned values; empty: none; not given: BVHBENCH_TUNING
    std::size_t memory_limit = 0;  ///< bytes of the device and of the host each; 0: what there is
    double time_limit_s = 600;     ///< of a single build or query; 0: none
    bool verbose = false;
};

/// --help and --version: nothing to do but print.
struct PrintCommand {
    std::string text;
};
struct ListCommand {
    std::string
        what;  ///< builders, colliders, narrow, orders, skips, tuning, scenes, devices, accuracy or experiments
};
struct BuildCommand {
    BuilderChoice builder;
    std::string scene;
    int samples = 20;
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
    int samples = 20;
    bool skips = false;    ///< whether each rule is measured switched off as well
    std::string json;      ///< result file to write; may be empty
    std::string pairs;     ///< file for the last frame's pairs, .csv or .bin; may be empty
    std::string contacts;  ///< likewise for its contacts
};
struct RunCommand {
    std::string experiment;  ///< a name or a path
    std::string out;         ///< result file; empty: <experiment>.json
    std::string filter;      ///< regular expression on "scene/builder"
    int samples = 0;         ///< 0: as the experiment says
    bool quick = false;
    bool quality = false;
    NodeCosts costs;
};
struct ReproduceCommand {
    std::string what;  ///< table1 to table4, fig8, fig9, fig10 or fig13
    std::string out = "out";
    bool quick = false;
    bool quality = false;
    NodeCosts costs;
};
struct CheckCommand {
    std::string builder;  ///< empty: all
    std::string scene;    ///< empty: the hard inputs
};
struct ShowCommand {
    std::string file;
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

using Command = std::variant<PrintCommand, ListCommand, BuildCommand, CollideCommand, RunCommand,
                             ReproduceCommand, CheckCommand, ShowCommand, TuneCommand,
                             AccuracyCommand, StressCommand>;

struct Options {
    CommonOptions common;
    Command command;
    std::vector<std::string> words;  ///< argv, for the result file
};

/// Throws BadUsage, in one sentence, for anything that is not understood.
Options parse_options(int argc, const char* const* argv);

}  // namespace bvhbench
