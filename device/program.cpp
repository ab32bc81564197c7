// SPDX-License-Identifier: MIT
#include "device/program.h"

#include <chrono>

namespace bvhbench {
namespace {

/// OpenCL lets division be 2.5 ulp off unless asked; codes are compared bit for bit with the host's.
bool can_round_division(const cl::Device& device)
{
    return (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) !=
           0;
}

}  // namespace

Programs::Programs(const Device& device, std::string dialect)
    : device_(device), dialect_(std::move(dialect))
{}

cl::Kernel Programs::kernel(std::string_view path, const char* name,
                            std::initializer_list<Define> defines, Optimise optimise)
{
    return compiled(device_.sources.flatten(path), path, name,
                    std::span(defines.begin(), defines.size()), optimise);
}

cl::Kernel Programs::kernel(std::string_view header, std::string_view path, const char* name,
                            std::span<const Define> defines, Optimise optimise)
{
    return compiled(device_.sources.flatten({header, path}), path, name, defines, optimise);
}

cl::Kernel Programs::compiled(const std::string& text, std::string_view path, const char* name,
                              std::span<const Define> defines, Optimise optimise)
{
    std::string options = "-cl-std=" + dialect_;
    if (optimise == Optimise::on_gpus && device_.is_cpu())
        options += " -cl-opt-disable";
    if (can_round_division(device_.cl))
        options += " -cl-fp32-correctly-rounded-divide-sqrt";
    for (const Define& define : defines)
        options += " -D " + std::string(define.name) + '=' + std::to_string(define.value) + 'u';

    const std::string key = options + '\n' + text;
    auto found = programs_.find(key);
    if (found == programs_.end())
        found = programs_.emplace(key, build(path, text, options)).first;
    const cl::Kernel kernel(found->second, name);
    device_.require_group(
        std::string(path) + ": " + name,
        kernel.getWorkGroupInfo<CL_KERNEL_COMPILE_WORK_GROUP_SIZE>(device_.cl)[0],
        kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device_.cl));
    return kernel;
}

cl::Program Programs::build(std::string_view path, const std::string& text,
                            const std::string& options)
{
    using clock = std::chrono::steady_clock;
    const auto start = clock::now();
    cl::Program program(device_.context, text);
    try {
        program.build(device_.cl, options.c_str());
    } catch (const cl::BuildError& error) {
        std::string message = std::string(path) + " did not build with " + options;
        for (const auto& [built_for, log] : error.getBuildLog())
            message += '\n' + built_for.getInfo<CL_DEVICE_NAME>() + ":\n" + log;
        throw BuildFailure(message);
    }
    compile_ns_ += std::chrono::nanoseconds(clock::now() - start).count();
    return program;
}

}  // namespace bvhbench
