// SPDX-License-Identifier: MIT
#include "device/program.h"

#include <algorithm>
#include <chrono>

#include "device/lifted_limit.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

/// True if the device can round division correctly. By default OpenCL allows an error of 2.5 ulp, but codes must equal the
/// host's bit for bit.
bool can_round_division(const cl::Device& device)
{
    return (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) !=
           0;
}

/// Host memory that a driver's compiler needs for a program, approximately. LLVM ends the process if an allocation fails.
constexpr std::size_t compiler_bytes = std::size_t{64} << 20;

/// True for PoCL 3.1, the driver that device/builtins.clh was written for.
bool is_slow_to_declare(const cl::Device& device)
{
    const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
    return platform.getInfo<CL_PLATFORM_VERSION>().find("PoCL 3.1") != std::string::npos;
}

/// Returns the embedded text of device/builtins.clh, even if kernels come from a source tree.
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
    return kernel({}, path, name, defines, optimise);
}

cl::Kernel Programs::kernel(std::string_view header, std::string_view path, const char* name,
                            std::span<const Define> defines, Optimise optimise)
{
    std::string options = "-cl-std=" + dialect_;
    if (optimise == Optimise::on_gpus && device_.is_cpu())
        options += " -cl-opt-disable";
    if (can_round_division(device_.cl))
        options += " -cl-fp32-correctly-rounded-divide-sqrt";
    for (const Define& define : defines)
        options += " -D " + std::string(define.name) + '=' + std::to_string(define.value) + 'u';

    const std::string key = options + '\n' + std::string(header) + '\n' + std::string(path);
    auto found = programs_.find(key);
    if (found == programs_.end()) {
        const Sources& sources = device_.sources;
        const std::string text =
            header.empty() ? sources.flatten({path}) : sources.flatten({header, path});
        found = programs_.emplace(key, build(path, text, options)).first;
    }
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
    compile_ns_ +=
        std::max<std::int64_t>(0, std::chrono::nanoseconds(clock::now() - start).count());
    return program;
}

cl::Program Programs::built(const std::string& text, const std::string& options) const
{
    const LiftedLimit lifted;
    if (declares_builtins_) {
        cl::Program program(device_.context, builtins() + text);
        try {
            // The define is the include guard of PoCL's header with all declarations, which PoCL then skips.
            program.build(device_.cl, (options + " -D _OPENCL_H_").c_str());
            return program;
        } catch (const cl::BuildError&) {
            // A function is not declared, or the program has an error, which the build below reports.
        }
    }
    cl::Program program(device_.context, text);
    program.build(device_.cl, options.c_str());
    return program;
}

}  // namespace bvhbench
