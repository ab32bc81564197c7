// SPDX-License-Identifier: MIT
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "builders/builder.h"
#include "device/yardsticks.h"
#include "harness/base/common_options.h"
#include "harness/choice/catalog.h"
#include "harness/session/pocl_cache.h"
#include "harness/session/turns.h"
#include "scenes/catalog.h"

namespace bvhbench {

/// What a command works with: one device, its compiled programs, its queue, and builders made once.
class Session {
public:
    /// Opens the device. Throws Unavailable if there is none.
    explicit Session(const CommonOptions& common);

    /// The same of a device that is open, its programs compiled anew: for one that is tuned otherwise.
    Session(Device device, SceneLibrary library);

    const Device& device() const { return device_; }
    Programs& programs() { return programs_; }
    Queue& queue() { return *queue_; }
    const SceneLibrary& scenes() const { return library_; }

    /// What becomes from here on of coordinates that floats cannot hold; none: what the command line said.
    void read_doubles(std::optional<Doubles> how)
    {
        library_.doubles = how.value_or(doubles_asked_);
    }

    /// Forget what a failed build left in the queue.
    void renew_queue();

    /// The builder chosen so: made when first asked for, then reused through reserve(), so that a thousand
    /// scenes cost one compilation. One for each operation: what is refitted must stand while others build.
    /// Throws as make_builder does.
    Builder& builder(const BuilderChoice& choice, Operation operation = Operation::build);

    /// Before work that is timed is enqueued: caches are emptied, if samples are to find them so, and a GPU gets a head
    /// start (device/yardsticks.h).
    void give_head_start();

    /// Whether what is timed from here on finds caches empty. Throws what taking their size of memory throws.
    void empty_caches(bool before_each);

    /// Sample by turns with other runs, if `path` is not empty: "FILE:N", N runs that name the file; `id` is this one's.
    /// Throws BadUsage and Unavailable.
    void take_turns(const std::string& path, const std::string& id);
    Turns* turns() { return turns_ ? &*turns_ : nullptr; }

    /// What a fixed piece of work takes right now, in nanoseconds (device/yardsticks.h).
    std::int64_t calibrate();

    /// One whole build, waited for and watched. Throws what the builder throws.
    std::vector<StageTime> build_once(Builder& builder, const Input& input, Start start,
                                      const Tree** tree = nullptr);

    /// One refit of the tree that stands, waited for and watched. Throws what the builder throws.
    std::vector<StageTime> refit_once(Builder& builder, const Input& input,
                                      const Tree** tree = nullptr);

private:
    Session(std::unique_ptr<PoclCache> cache, const CommonOptions& common);

    struct Made {
        BuilderChoice choice;
        Operation operation;
        std::unique_ptr<Builder> builder;
    };

    std::unique_ptr<PoclCache> cache_;  ///< outlives all that runs kernels
    Device device_;
    Programs programs_;
    std::unique_ptr<Queue> queue_;
    std::optional<HeadStart> head_start_;  ///< this and the next two are made when first asked for
    std::optional<CacheFlush> cache_flush_;
    std::optional<Calibration> calibration_;
    bool cold_ = false;
    std::optional<Turns> turns_;
    SceneLibrary library_;
    Doubles doubles_asked_ = library_.doubles;
    /// A list, so that choices stay where they are: builders may keep looking at their words.
    std::list<Made> builders_;
};

/// Where scenes are read from: --data, else BVHBENCH_DATA.
SceneLibrary scene_library(const CommonOptions& common);

/// The device --device asks for, with kernels from --kernels and tuned as --tuning says. Throws Unavailable.
/// A PoclCache must be there first.
Device open_device_of(const CommonOptions& common);

}  // namespace bvhbench
