// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>

#include "device/program.h"
#include "device/queue.h"
#include "tests/folder.h"
#include "tests/refusal.h"

namespace bvhbench {

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

    Folder folder;
    Device device = open_device("", Sources::tree(folder.path()));
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
