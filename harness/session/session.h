// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "builders/builder.h"
#include "device/yardsticks.h"
#include "harness/base/common_options.h"
#include "harness/choice/catalog.h"
#include "harness/choice/sampling.h"
#include "harness/record/end_of_run.h"
#include "harness/session/other_processes.h"
#include "harness/session/pocl_cache.h"
#include "harness/session/turns.h"
#include "scenes/catalog.h"

namespace bvhbench {

struct Cell;
struct Measurement;

/// The sampler of a program with one of its own (benchmarks/). Empty functions leave it to the engine (measure/engine.h).
struct OtherSampler {
    std::function<void(std::span<Measurement>)> sample = {};  ///< samples what is ready
    std::function<bool(const Cell&)> is_wanted = {};          ///< whether a cell is prepared at all
};

/// The objects that a command works with: one device, its compiled programs, its queue, and builders that are made once.
class Session {
public:
    /// Opens the device of the options. Throws Unavailable if there is none.
    explicit Session(const CommonOptions& common);

    /// Uses an open device, for example one tuned differently, and compiles its programs anew.
    Session(Device device, SceneLibrary library);

    const Device& device() const { return device_; }
    Programs& programs() { return programs_; }
    Queue& queue() { return *queue_; }
    const SceneLibrary& scenes() const { return library_; }

    /// Sets how coordinates that floats cannot hold are rounded from now on; nothing: as on the command line.
    void read_doubles(std::optional<Doubles> how)
    {
        library_.doubles = how.value_or(doubles_asked_);
    }

    /// Discards the launches that a failed build left in the queue.
    void renew_queue();

    /// Returns the chosen builder. It is made at the first request and then reused through reserve(), so that many scenes cost
    /// one compilation. Each operation has its own builder, because a tree to refit must survive builds for other cells. Throws
    /// as make_builder does.
    Builder& builder(const BuilderChoice& choice, Operation operation = Operation::build);

    /// Prepares a timed sample before its work is enqueued: empties the caches if samples are cold, and gives a GPU a head start
    /// (device/yardsticks.h) unless the sample begins on the host.
    void give_head_start();

    /// Sets where samples from now on find their data. Throws if the memory for emptying caches cannot be allocated.
    void set_caches(Caches caches);

    /// Samples by turns with other runs if `path` is not empty. It is "FILE:N": N runs name the file. `id` names this run. Throws
    /// BadUsage or Unavailable.
    void take_turns(const std::string& path, const std::string& id);
    Turns* turns() { return turns_ ? &*turns_ : nullptr; }

    OtherSampler other_sampler;

    OtherProcesses& other_processes() { return other_processes_; }

    /// Returns what is known of a run only when it ends.
    EndOfRun end_of_run() const;

    /// Runs one sample and returns its stages. Throws BadClock if their times cannot be true, and what `once` throws.
    std::vector<StageTime> timed(const std::function<std::vector<StageTime>()>& once);

    /// Throws Unavailable if the device's clock and the host's disagree about a known kernel (device/yardsticks.h). Without room for
    /// it, nothing is known.
    void check_clocks();

    /// Returns the nanoseconds that a fixed piece of work takes now (device/yardsticks.h).
    std::int64_t calibrate();

    /// Runs one whole build under the watchdog and waits for it. Throws what the builder throws.
    std::vector<StageTime> build_once(Builder& builder, const Input& input, Start start,
                                      const Tree** tree = nullptr);

    /// Refits the builder's current tree under the watchdog and waits. Throws what the builder throws.
    std::vector<StageTime> refit_once(Builder& builder, const Input& input,
                                      const Tree** tree = nullptr);

private:
    struct Made {
        BuilderChoice choice;
        Operation operation;
        std::unique_ptr<Builder> builder;
    };

    /// Made first: drivers look up their cache folder when their devices are queried. Outlives everything that runs kernels.
    std::optional<PoclCache> cache_;
    Device device_;
    Programs programs_{device_};
    std::unique_ptr<Queue> queue_ = std::make_unique<Queue>(device_);
    std::optional<HeadStart> head_start_;  ///< this and the next two are made at the first use
    std::optional<CacheFlush> cache_flush_;
    std::optional<Calibration> calibration_;
    Caches caches_ = Caches::hot;
    std::optional<Turns> turns_;
    OtherProcesses other_processes_;
    SceneLibrary library_;
    Doubles doubles_asked_ = library_.doubles;
    std::vector<Made> builders_;
};

/// Returns the scene library of the folder --data, else BVHBENCH_DATA.
SceneLibrary scene_library(const CommonOptions& common);

/// Opens the device of --device, with kernels from --kernels and tuned values from --tuning. Throws Unavailable. A PoclCache must
/// exist before.
Device open_device_of(const CommonOptions& common);

}  // namespace bvhbench
