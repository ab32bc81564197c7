// SPDX-License-Identifier: MIT
#include "harness/session.h"

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "geometry/error.h"
#include "harness/pocl_cache.h"

namespace bvhbench {

SceneLibrary scene_library(const CommonOptions& common)
{
    SceneLibrary library;
    const char* variable = std::getenv("BVHBENCH_DATA");
    library.data = !common.data.empty() ? common.data : variable != nullptr ? variable : "";
    return library;
}

Device open_device_of(const CommonOptions& common)
{
    prepare_pocl_cache();
    if (common.kernels.empty())
        return open_device(common.device);
    if (!std::filesystem::is_directory(common.kernels))
        throw Unavailable("--kernels: there is no folder '" + common.kernels + "'");
    return open_device(common.device, Sources::tree(common.kernels));
}

Session::Session(const CommonOptions& common)
    : device_(open_device_of(common))
    , programs_(device_)
    , queue_(std::make_unique<Queue>(device_))
    , library_(scene_library(common))
{
    if (common.verbose)
        std::cerr << "device: " << device_.platform() << '/' << device_.name()
                  << "\nkernels: " << device_.sources.origin() << '\n';
}

void Session::renew_queue() { queue_ = std::make_unique<Queue>(device_); }

Builder& Session::builder(const BuilderChoice& choice)
{
    for (auto& [known, builder] : builders_)
        if (known == choice)
            return *builder;
    // The choice is stored first: the builder may keep looking at its words.
    builders_.emplace_back(choice, nullptr);
    try {
        builders_.back().second = make_builder(builders_.back().first, programs_);
    } catch (...) {
        builders_.pop_back();
        throw;
    }
    return *builders_.back().second;
}

std::vector<StageTime> Session::build_once(Builder& builder, const Input& input, Start start,
                                           const Tree** tree)
{
    const Tree& built = builder.build(input, queue(), start);
    if (tree != nullptr)
        *tree = &built;
    return queue().finish();
}

}  // namespace bvhbench
