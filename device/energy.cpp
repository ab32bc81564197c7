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

/// Loads NVIDIA's library at the first use, because only machines with an NVIDIA card have it.
void* nvml()
{
    static void* const library = dlopen("libnvidia-ml.so.1", RTLD_NOW);
    return library;
}

template <class Function>
Function* of_nvml(const char* name)
{
    void* const found = nvml() == nullptr ? nullptr : dlsym(nvml(), name);
    if (found == nullptr)
        tells_none(std::string("no ") + name + " in libnvidia-ml.so.1");
    return reinterpret_cast<Function*>(found);
}

/// Returns where NVML finds the card, by cl_nv_device_attribute_query: a slot has the device and, in three bits, its function.
std::string place_of(const cl::Device& device)
{
    constexpr cl_device_info attributes[] = {0x400A, 0x4008, 0x4009};  // domain, bus, slot
    cl_uint found[3] = {};
    for (const int k : {0, 1, 2})
        if (clGetDeviceInfo(device(), attributes[k], sizeof found[k], &found[k], nullptr) !=
                CL_SUCCESS &&
            k > 0)  // older drivers have no domain
            tells_none("its driver does not say where it is");
    char place[40];
    std::snprintf(place, sizeof place, "%08x:%02x:%02x.%x", found[0], found[1], found[2] >> 3,
                  found[2] & 7);
    return place;
}

std::function<double()> joules_of_card(const cl::Device& device)
{
    const std::string place = place_of(device);
    void* handle = nullptr;
    if (of_nvml<int()>("nvmlInit_v2")() != 0 ||
        of_nvml<int(const char*, void**)>("nvmlDeviceGetHandleByPciBusId_v2")(place.c_str(),
                                                                              &handle) != 0)
        tells_none("NVML does not know a card at " + place);
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
        const std::filesystem::path folder = entry.path();
        std::string name;
        if (folder.filename().string().starts_with("intel-rapl:") &&
            std::ifstream(folder / "name") >> name && name.starts_with("package"))
            packages.push_back({folder, microjoules(folder / "max_energy_range_uj"),
                                microjoules(folder / "energy_uj")});
    }
    if (packages.empty())
        tells_none("no package of intel-rapl in " + powercap.string());
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
