// SPDX-License-Identifier: MIT
#include "device/program.h"

#include <chrono>

#include "device/lifted_limit.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

/// OpenCL lets division be 2.5 ulp off unless asked; codes are compared bit for bit with the host's.
bool can_round_division(const cl::Device& device)
{
    return (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) !=
           0;
}

/// What a driver's compiler takes for a program, about. LLVM ends the process where an allocation fails.
constexpr std::size_t compiler_bytes = std::size_t{64} << 20;

/// Whether the driver is the one that device/builtins.clh was written for.
bool is_slow_to_declare(const cl::Device& device)
{
    const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
    return platform.getInfo<CL_PLATFORM_VERSION>().find("PoCL 3.1") != std::string::npos;
}

/// Of the program, whichever source tree kernels are from: one file for all of them.
const std::string& builtins()
{
    static const std::string text = "#line 1 \"device/builtins.clh\"\n" +
                                    std::string(embedded_kernel("device/builtins.clh").value());
    return text;
}

}  // namespace

Programs::Programs(const Device& device, std::string dialect)
    : device_(device)
    , dialect_(std::move(dialect))
    , declares_builtins_(dialect_ == "CL1.2" && is_slow_to_declare(device.cl))
{}

cl::Kernel Programs::kernel(std::string_view path, const char* name,
                            std::initializer_list<Define> defines, Optimise optimise)
{
    return kernel(path, name, std::span(defines.begin(), defines.size()), optimise);
}

cl::Kernel Programs::kernel(std::string_view path, const char* name,
                            std::span<const Define> defines, Optimise optimise)
{
    return compiled(device_.sources.flatten({path}), path, name, defines, optimise);
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
    device_.require_group(std::string(path) + ": " + name,
                          kernel.getWorkGroupInfo<CL_KERNEL_COMPILE_WORK_GROUP_SIZE>(device_.cl)[0],
                          kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device_.cl));
    return kernel;
}

cl::Program Programs::build(std::string_view path, const std::string& text,
                            const std::string& options)
{
    using clock = std::chrono::steady_clock;
    const auto start = clock::now();
    require_host_memory("compiling kernels", compiler_bytes);
    cl::Program program;
    try {
        program = built(text, options);
    } catch (const cl::BuildError& error) {
        std::string message = std::string(path) + " did not build with " + options;
        for (const auto& [built_for, log] : error.getBuildLog())
            message += '\n' + built_for.getInfo<CL_DEVICE_NAME>() + ":\n" + log;
        throw BuildFailure(message);
    }
    compile_ns_ += std::chrono::nanoseconds(clock::now() - start).count();
    return program;
}

cl::Program Programs::built(const std::string& text, const std::string& options) const
{
    const LiftedLimit lifted;
    if (declares_builtins_) {
        cl::Program program(device_.context, builtins() + text);
        try {
            // The guard of the header that declares all functions: PoCL then finds it included.
            program.build(device_.cl, (options + " -D _OPENCL_H_").c_str());
            return program;
        } catch (
            const cl::
                BuildError&) {  // a function that is not in the file, or an error, which is reported below
        }
    }
    cl::Program program(device_.context, text);
    program.build(device_.cl, options.c_str());
    return program;
}

}  // namespace bvhbench
