// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>

#include "device/program.h"
#include "device/queue.h"
#include "geometry/error.h"
#include "tests/refusal.h"

namespace bvhbench {

/// A temporary folder of kernel files, removed by the destructor.
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

class OnDevice : public testing::Test {
protected:
    Device device = open_device("");
    Programs programs{device};
    Queue queue{device};
};

/// Fixture with a device whose kernels come from a folder that the test writes.
class OnDeviceWithKernels : public testing::Test {
protected:
    template <class T>
    Buffer<T> buffer(std::size_t size)
    {
        return {cl::Buffer(device.context, CL_MEM_READ_WRITE, size * sizeof(T)), size};
    }

    KernelFolder folder;
    Device device = open_device("", folder.sources());
    Programs programs{device};
    Queue queue{device};
};

/// Expects the message to be one line that contains all `parts`.
inline void expect_sentence(const std::string& message, std::initializer_list<std::string> parts)
{
    for (const std::string& part : parts)
        EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << "one sentence";
}

}  // namespace bvhbench
