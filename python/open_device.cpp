// SPDX-License-Identifier: MIT
#include "python/open_device.h"

#include <map>
#include <mutex>

#include "device/device.h"
#include "device/device_choice.h"
#include "library/device.h"

namespace bvhbench::python {
namespace {

std::shared_ptr<OpenDevice> open(const std::string& words)
{
    const bvhbench::Device device = open_device(words, Sources::embedded());
    const cl::CommandQueue queue(device.context, device.cl);
    return std::make_shared<OpenDevice>(OpenDevice{.name = device.platform() + '/' + device.name(),
                                                   .shares_host_memory = device.is_cpu(),
                                                   .queue = queue,
                                                   .device = oibvh::Device(queue())});
}

}  // namespace

std::shared_ptr<OpenDevice> opened(const std::string& words)
{
    static std::mutex mutex;
    static std::map<std::size_t, std::shared_ptr<OpenDevice>> devices;  // by index
    const std::scoped_lock lock(mutex);
    try {
        const std::vector<std::size_t> matching = matching_devices(words);
        if (matching.empty())
            return open(words);  // throws, with the list of devices
        std::shared_ptr<OpenDevice>& device = devices[matching.front()];
        if (device == nullptr)
            device = open(std::to_string(matching.front()));
        return device;
    } catch (const oibvh::Error&) {
        throw;
    } catch (...) {
        oibvh::rethrow_as_error();
    }
}

}  // namespace bvhbench::python
