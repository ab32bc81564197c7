// SPDX-License-Identifier: MIT
#include "device/energy.h"

#include <dlfcn.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// Throws Unavailable.
[[noreturn]] void tells_none(const std::string& why)
{
    throw Unavailable("the device does not tell its energy: " + why);
}

/// Returns a function of NVIDIA's library. It is loaded at the first use, because only machines with a card of NVIDIA have it.
template <class Function>
Function* of_nvml(const char* name)
{
    static void* const library = dlopen("libnvidia-ml.so.1", RTLD_NOW);
    void* const found = library == nullptr ? nullptr : dlsym(library, name);
    if (found == nullptr)
        tells_none(std::string("no ") + name + " in libnvidia-ml.so.1");
    return reinterpret_cast<Function*>(found);
}

/// Returns a property of cl_nv_device_attribute_query.
cl_uint attribute(const cl::Device& device, cl_device_info what)
{
    cl_uint value = 0;
    if (clGetDeviceInfo(device(), what, sizeof value, &value, nullptr) != CL_SUCCESS)
        tells_none("its driver does not say where it is");
    return value;
}

std::function<double()> joules_of_card(const cl::Device& device)
{
    constexpr cl_device_info bus = 0x4008, slot = 0x4009, domain = 0x400A;
    char place[40];
    std::snprintf(place, sizeof place, "%08x:%02x:%02x.0", attribute(device, domain),
                  attribute(device, bus), attribute(device, slot));
    void* handle = nullptr;
    if (of_nvml<int()>("nvmlInit_v2")() != 0 ||
        of_nvml<int(const char*, void**)>("nvmlDeviceGetHandleByPciBusId_v2")(place, &handle) != 0)
        tells_none(std::string("NVML does not know a card at ") + place);
    const auto read =
        of_nvml<int(void*, unsigned long long*)>("nvmlDeviceGetTotalEnergyConsumption");
    return [handle, read] {
        unsigned long long millijoules = 0;
        if (read(handle, &millijoules) != 0)
            tells_none("NVML does not count that of this card");
        return static_cast<double>(millijoules) * 1e-3;
    };
}

/// A counter of microjoules, which begins again at 0 after the most that it can be.
struct Package {
    std::filesystem::path folder;
    double most = 0, last = 0, all = 0;
};

double microjoules(const std::filesystem::path& file)
{
    double value = 0;
    if (!(std::ifstream(file) >> value))
        tells_none(file.string() + " cannot be read");
    return value;
}

std::function<double()> joules_of_packages(const std::filesystem::path& powercap)
{
    std::vector<Package> packages;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(powercap, none)) {
        const std::string name =
            entry.path().filename().string();  // intel-rapl:0; with parts intel-rapl:0:1
        if (name.starts_with("intel-rapl:") && name.rfind(':') == name.find(':'))
            packages.push_back({entry.path(), microjoules(entry.path() / "max_energy_range_uj"),
                                microjoules(entry.path() / "energy_uj")});
    }
    if (packages.empty())
        tells_none("no intel-rapl in " + powercap.string());
    return [packages]() mutable {
        double joules = 0;
        for (Package& one : packages) {
            const double now = microjoules(one.folder / "energy_uj");
            one.all += now - one.last + (now < one.last ? one.most : 0);
            one.last = now;
            joules += one.all * 1e-6;
        }
        return joules;
    };
}

}  // namespace

std::function<double()> energy_counter(const Device& device, const std::filesystem::path& powercap)
{
    std::function<double()> joules =
        device.is_cpu() ? joules_of_packages(powercap) : joules_of_card(device.cl);
    joules();  // throws now what it would throw later
    return joules;
}

}  // namespace bvhbench
