// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string_view>

#include "device/sources.h"

namespace bvhbench {

/// A folder of kernel files, removed at the end.
class KernelFolder {
public:
    KernelFolder()
        : path_(std::filesystem::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name())
    {
        std::filesystem::create_directories(path_);
    }
    ~KernelFolder() { std::filesystem::remove_all(path_); }

    void write(std::string_view name, std::string_view text)
    {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name) << text;
    }
    Sources sources() const { return Sources::tree(path_); }

private:
    std::filesystem::path path_;
};

}  // namespace bvhbench
