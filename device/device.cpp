// SPDX-License-Identifier: MIT
#include "device/device.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "device/device_choice.h"
#include "device/lifted_limit.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

struct Found {
    cl::Device device;
    NamedDevice named;
};

std::vector<Found> all_devices()
{
    const LiftedLimit lifted;
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {  // the loader reports "no platform" as an error
    }
    std::vector<Found> found;
    for (const cl::Platform& platform : platforms) {
        std::vector<cl::Device> devices;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
        } catch (const cl::Error&) {  // a platform without devices reports an error, too
        }
        for (const cl::Device& device : devices)
            found.push_back(
                {device,
                 {platform.getInfo<CL_PLATFORM_NAME>() + '/' + device.getInfo<CL_DEVICE_NAME>(),
                  device.getInfo<CL_DEVICE_TYPE>()}});
    }
    return found;
}

/// True if a loop of 100,000 iterations ends early on the device. Compiles and runs a kernel to find out.
bool ends_loops_early(const Device& device)
{
    constexpr cl_uint steps = 100'000;
    cl_uint expected = 0;
    for (cl_uint step = 0; step < steps; ++step)
        expected = (expected ^ step) * 1664525u + 1013904223u;

    cl::Program program(device.context, device.sources.flatten({"device/limits.cl"}));
    program.build(device.cl);
    cl::Kernel kernel(program, "take_steps");
    const cl::CommandQueue queue(device.context, device.cl);
    const cl::Buffer word(device.context, CL_MEM_WRITE_ONLY, sizeof(cl_uint));
    kernel.setArg(0, word);
    kernel.setArg(1, steps);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
    cl_uint found = 0;
    queue.enqueueReadBuffer(word, CL_TRUE, 0, sizeof found, &found);
    return found != expected;
}

/// Returns a sentence that says where the loader looked for drivers, which variables of the environment change what it finds, and
/// which package brings a driver.
std::string no_device()
{
    const char* vendors = std::getenv("OCL_ICD_VENDORS");
    std::string text = "there is no OpenCL device: drivers are named in ";
    text += vendors != nullptr ? "'" + std::string(vendors) + "' (OCL_ICD_VENDORS)"
                               : "/etc/OpenCL/vendors";
    std::string names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(
             vendors != nullptr ? vendors : "/etc/OpenCL/vendors", error))
        if (entry.path().extension() == ".icd")
            names += (names.empty() ? "" : ", ") + entry.path().filename().string();
    text += ", which " + std::string(error           ? "is no folder"
                                     : names.empty() ? "has none"
                                                     : "has " + names);
    for (const char* variable : {"POCL_DEVICES", "CUDA_VISIBLE_DEVICES", "RUSTICL_ENABLE"})
        if (const char* value = std::getenv(variable))
            text += "; " + std::string(variable) + " is '" + value + "'";
    return text + "; Debian's pocl-opencl-icd brings one for processors";
}

}  // namespace

std::string Device::platform() const
{
    return cl::Platform(cl.getInfo<CL_DEVICE_PLATFORM>()).getInfo<CL_PLATFORM_NAME>();
}

MemoryShare Device::take_memory(std::size_t bytes) const
{
    const std::size_t all = memory_bytes();
    if (bytes > all - std::min(all, *taken))
        refuse_memory(bytes, "", all);
    if (is_cpu())
        require_host_memory("memory of " + name(), bytes);
    *taken += bytes;
    *most_taken = std::max(*most_taken, *taken);
    return {new std::size_t(bytes), [account = taken](const std::size_t* share) {
                *account -= *share;
                delete share;
            }};
}

void Device::require_at_once(std::size_t bytes) const
{
    if (bytes > most_at_once())
        refuse_memory(bytes, " in one piece", most_at_once());
}

void Device::refuse_memory(std::size_t bytes, std::string_view how, std::size_t given) const
{
    throw Unavailable("out of device memory: " + std::to_string(bytes) + " bytes are needed" +
                      std::string(how) +
                      (*taken > 0 ? " beside " + std::to_string(*taken) + " taken" : "") + ", " +
                      name() + " gives " + std::to_string(given));
}

void Device::require_group(std::string_view what, std::size_t group_size,
                           std::size_t local_bytes) const
{
    const std::size_t most = cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    if (group_size > most)
        throw Unavailable(std::string(what) + " needs groups of " + std::to_string(group_size) +
                          " work-items, and " + name() + " has them up to " + std::to_string(most));
    const std::size_t local = cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
    // NVIDIA's driver (580.159) reports 8 bytes more than a kernel declares, yet runs one that declares all local memory.
    const std::size_t said_besides = is_nvidia() ? 8 : 0;
    if (local_bytes > local + said_besides)
        throw Unavailable(std::string(what) + " needs " + std::to_string(local_bytes) +
                          " bytes of local memory, and a group has " + std::to_string(local) +
                          " on " + name());
}

std::vector<std::size_t> matching_devices(std::string_view words)
{
    std::vector<NamedDevice> named;
    for (Found& found : all_devices())
        named.push_back(std::move(found.named));
    return matching_devices(named, device_words(words));
}

std::vector<std::string> device_names()
{
    std::vector<std::string> names;
    for (Found& found : all_devices())
        names.push_back(std::move(found.named.name));
    return names;
}

std::string device_words(std::string_view words)
{
    const char* variable = std::getenv("BVHBENCH_DEVICE");
    return words.empty() && variable != nullptr ? variable : std::string(words);
}

Device open_device(std::string_view words, Sources sources)
{
    const std::string wanted = device_words(words);
    const std::vector<Found> devices = all_devices();
    std::vector<NamedDevice> named;
    for (const Found& found : devices)
        named.push_back(found.named);
    const std::size_t chosen = chosen_device(named, wanted);
    if (chosen < devices.size()) {
        const cl::Device& found = devices[chosen].device;
        Device device{.cl = found, .context = cl::Context(found), .sources = std::move(sources)};
        // CPU kernels have long loops. PoCL is not probed, because one more program costs it 40 ms at every start.
        if (device.is_cpu() && device.platform() != "Portable Computing Language")
            device.ends_loops = ends_loops_early(device);
        return device;
    }

    if (devices.empty())
        throw Unavailable(no_device());
    std::string known;
    for (std::size_t i = 0; i < named.size(); ++i)
        known += (i == 0 ? "" : ", ") + std::to_string(i) + " = " + named[i].name;
    throw Unavailable("no OpenCL device matches '" + wanted + "'" +
                      (words.empty() && !wanted.empty() ? " of BVHBENCH_DEVICE" : "") + "; there " +
                      (devices.size() == 1 ? "is " : "are ") + known);
}

}  // namespace bvhbench
