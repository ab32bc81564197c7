// SPDX-License-Identifier: MIT
#include "library/device.h"

#include <algorithm>
#include <cstdio>

#include "builders/parameters.h"
#include "builders/stages/kernel_form.h"
#include "collide/parameters.h"
#include "geometry/error.h"

namespace bvhbench::oibvh {
namespace {

/// CL_QUEUE_ON_DEVICE of OpenCL 2.0: a queue that kernels enqueue into. OpenCL 1.2 does not define it.
constexpr cl_command_queue_properties on_device = cl_command_queue_properties{1} << 2;

void require_compiler(const bvhbench::Device& device)
{
    int major = 0, minor = 0;
    const std::string version = device.cl.getInfo<CL_DEVICE_VERSION>();
    if (std::sscanf(version.c_str(), "OpenCL %d.%d", &major, &minor) == 2 &&
        10 * major + minor < 12)
        throw bvhbench::Unavailable("OpenCL 1.2 is needed, and " + device.name() + " has " +
                                    version);
    if (device.cl.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() == CL_FALSE)
        throw bvhbench::Unavailable("kernels are compiled at run time, and " + device.name() +
                                    " has no compiler");
}

const Parameter& find_parameter(const std::string& name)
{
    for (const Parameter* parameter : builder_parameters)
        if (parameter->name == name)
            return *parameter;
    for (const Parameter* parameter : collider_parameters)
        if (parameter->name == name)
            return *parameter;
    throw BadUsage("no tuning parameter is called '" + name + "'; `bvhbench list tuning` has them");
}

void tune(bvhbench::Device& device, const DeviceOptions& options)
{
    const std::size_t most_group = device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    for (const auto& [name, value] : options.tuning) {
        const Parameter& parameter = find_parameter(name);
        if (const std::string why = parameter.refusal(value); !why.empty())
            throw BadUsage("tuning parameter " + name + ' ' + why);
        if (parameter.is_group_size && value > most_group)
            throw BadUsage("tuning parameter " + name + " is a group size, at most " +
                           std::to_string(most_group) + " on " + device.name() + ", not " +
                           std::to_string(value));
        device.tuning.set(parameter, value);
    }
}

/// Returns the internal device of the queue. Kernel text always comes from the binary, regardless of BVHBENCH_KERNELS.
bvhbench::Device device_of(const cl::CommandQueue& queue, const DeviceOptions& options)
{
    bvhbench::Device device{
        .cl = queue.getInfo<CL_QUEUE_DEVICE>(),
        .context = cl::Context(
            context_of(clGetCommandQueueInfo, queue(), CL_QUEUE_CONTEXT, "clGetCommandQueueInfo"),
            true),
        .sources = Sources::embedded()};
    device.memory_limit = options.memory_limit;
    require_compiler(device);
    tune(device, options);
    return device;
}

}  // namespace

cl::CommandQueue checked(cl_command_queue queue)
{
    if (queue == nullptr)
        throw BadUsage("a Device wants a cl_command_queue, and it is null");
    cl::CommandQueue callers(queue, true);
    if ((callers.getInfo<CL_QUEUE_PROPERTIES>() & on_device) != 0)
        throw BadUsage("a Device wants a queue of the host, and this one is on the device");
    return callers;
}

void rethrow_as_error()
{
    try {
        throw;
    } catch (const BadUsage& error) {
        throw BadInput(error.what());
    } catch (const bvhbench::Unavailable& error) {
        throw Unavailable(error.what());
    } catch (const BuildFailure& error) {
        throw OpenClFailure(error.what(), CL_BUILD_PROGRAM_FAILURE);
    } catch (const cl::Error& error) {
        throw OpenClFailure(
            std::string(error.what()) + " failed: " + opencl_error_name(error.err()), error.err());
    }
}

Device::Impl::Impl(const cl::CommandQueue& callers, const DeviceOptions& options)
    : device(device_of(callers, options)), programs(device), queue(device, callers)
{}

void Device::Impl::launch(cl::Kernel& kernel, std::size_t count)
{
    constexpr std::size_t most_items = std::size_t{1} << 20;
    const std::size_t group = device.is_cpu() ? 1 : 64;
    const std::size_t items = std::min(count, device.is_cpu() ? chunk_count(device) : most_items);
    queue.launch(kernel, (items + group - 1) / group * group, group, 0);
}

Device::Device(cl_command_queue queue, const DeviceOptions& options)
{
    try {
        impl_ = std::make_shared<Impl>(checked(queue), options);
    } catch (...) {
        rethrow_as_error();
    }
}

std::size_t Device::memory() const
{
    const std::scoped_lock lock(impl_->mutex);
    return *impl_->device.taken;
}

double Device::compile_seconds() const
{
    const std::scoped_lock lock(impl_->mutex);
    return 1e-9 * static_cast<double>(impl_->programs.compile_ns());
}

std::vector<Stage> Device::times()
{
    return as_call(*impl_, [&] {
        std::vector<Stage> stages;
        if (!impl_->queue.has_times())
            return stages;
        for (const StageTime& time : impl_->queue.finish())
            stages.push_back({time.stage, time.launches, time.busy_ns, time.span_ns});
        return stages;
    });
}

std::string_view version() { return BVHBENCH_VERSION; }

}  // namespace bvhbench::oibvh
