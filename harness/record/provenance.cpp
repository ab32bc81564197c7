// SPDX-License-Identifier: MIT
#include "harness/record/provenance.h"

#include <dlfcn.h>
#include <re2/re2.h>
#include <sys/utsname.h>

#include <array>
#include <ctime>
#include <fstream>
#include <map>
#include <random>

#include "geometry/hash.h"
#include "harness/base/build_info.h"
#include "harness/base/test_hooks.h"

namespace bvhbench {

namespace {

/// Returns the processor's name from /proc/cpuinfo; empty if there is none.
std::string processor()
{
    std::ifstream file("/proc/cpuinfo");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    std::string name;
    RE2::PartialMatch(text, "(?m)^model name[ \\t]*:[ \\t]*(.+)$", &name);
    return name;
}

/// Returns "ocl-icd 2.3.1". Only that loader reports its version, through an extension function.
std::string loader_version()
{
    using Info = int (*)(int what, std::size_t size, void* value, std::size_t* size_needed);
    constexpr int loader_version_text = 2;
    constexpr int loader_name = 3;
    const auto info = reinterpret_cast<Info>(dlsym(RTLD_DEFAULT, "clGetICDLoaderInfoOCLICD"));
    std::array<char, 128> name{};
    std::array<char, 128> version{};
    if (info == nullptr || info(loader_name, name.size() - 1, name.data(), nullptr) != 0 ||
        info(loader_version_text, version.size() - 1, version.data(), nullptr) != 0)
        return "unknown, headers " BVHBENCH_OPENCL_VERSION;
    return std::string(name.data()) + ' ' + version.data();
}

/// Removes the trailing blanks that some drivers add.
std::string trimmed(std::string text)
{
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

/// True if OpenCL C 3.0 programs may use acquire and release between work-groups. Drivers older than OpenCL 3.0 fail the query,
/// which gives false.
bool has_device_scope_acq_rel(const cl::Device& device)
{
    cl_device_atomic_capabilities can = 0;
    return clGetDeviceInfo(device(), CL_DEVICE_ATOMIC_MEMORY_CAPABILITIES, sizeof can, &can,
                           nullptr) == CL_SUCCESS &&
           (can & CL_DEVICE_ATOMIC_ORDER_ACQ_REL) != 0 &&
           (can & CL_DEVICE_ATOMIC_SCOPE_DEVICE) != 0;
}

std::string kind_of(const cl::Device& device)
{
    const auto type = device.getInfo<CL_DEVICE_TYPE>();
    return (type & CL_DEVICE_TYPE_CPU) != 0   ? "cpu"
           : (type & CL_DEVICE_TYPE_GPU) != 0 ? "gpu"
                                              : "other";
}

std::string now_as(const char* format)
{
    std::array<char, 32> text{};
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    std::strftime(text.data(), text.size(), format, &parts);
    return text.data();
}

std::string run_id(const std::string& host)
{
    return now_as("%Y%m%dT%H%M%SZ") + '-' + host + '-' + hex(std::random_device{}()).substr(12);
}

}  // namespace

std::string utc_now() { return now_as("%Y-%m-%dT%H:%M:%SZ"); }

Json device_facts(const Device& device)
{
    const cl::Device& cl = device.cl;
    return {{"name", device.name()},
            {"platform", device.platform()},
            {"driver", cl.getInfo<CL_DRIVER_VERSION>()},
            {"opencl", trimmed(cl.getInfo<CL_DEVICE_VERSION>())},
            {"opencl_c", trimmed(cl.getInfo<CL_DEVICE_OPENCL_C_VERSION>())},
            {"kind", kind_of(cl)},
            {"compute_units", cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()},
            {"global_memory_bytes", cl.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>()},
            {"max_allocation_bytes", cl.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>()},
            {"local_memory_bytes", cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>()},
            {"max_group_size", cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>()},
            {"timer_resolution_ns", cl.getInfo<CL_DEVICE_PROFILING_TIMER_RESOLUTION>()},
            {"correctly_rounded_division",
             (cl.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0},
            {"device_scope_acq_rel_atomics", has_device_scope_acq_rel(cl)}};
}

Json run_facts(const Device& device, std::vector<std::string> command, const NodeCosts& costs)
{
    utsname system{};
    uname(&system);
    const unsigned threads = std::thread::hardware_concurrency();
    if (!command.empty())  // the program's folder means nothing on other machines
        command.front() = std::filesystem::path(command.front()).filename().string();
    std::map<std::string, std::string> libraries = {{"assimp", BVHBENCH_ASSIMP_VERSION},
                                                    {"nlohmann_json", BVHBENCH_JSON_VERSION},
                                                    {"CLI11", BVHBENCH_CLI11_VERSION},
                                                    {"OpenCL loader", loader_version()}};
    // Only libraries that are compiled in, because results exist only for those.
#if BVHBENCH_HAS_EMBREE
    libraries["Embree"] = BVHBENCH_EMBREE_VERSION;
#endif
#if BVHBENCH_HAS_FCL
    libraries["FCL"] = BVHBENCH_FCL_VERSION;
#endif
    Json run = {{"id", run_id(system.nodename)}, {"started_at", utc_now()}, {"command", command}};
    run["program"] = {{"version", build_info.version},     {"commit", build_info.commit},
                      {"dirty", build_info.dirty},         {"build_type", build_info.build_type},
                      {"compiler", build_info.compiler},   {"arch", build_info.arch},
                      {"kernels", device.sources.origin()}};
    put_if(run["program"], "changed_files", build_info.changed_files);
    run["host"] = {{"name", system.nodename},
                   {"cpu", processor()},
                   {"threads", threads},
                   {"os", std::string(system.sysname) + ' ' + system.release}};
    run["device"] = device_facts(device);
    run["libraries"] = libraries;
    run["tuning"] = {{"from", device.tuning.origin()}, {"values", device.tuning.values()}};
    put_if(run, "clock", std::string(device.host_clock ? "host" : ""));
    run["compile_ns"] = 0;
    run["node_costs"] = {{"inner", costs.inner}, {"triangle", costs.triangle}};
    run["conditions"] = host_conditions(build_info.build_type);
    put_if(run, "test_hooks", test_hooks());
    return run;
}

}  // namespace bvhbench
