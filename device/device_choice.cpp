// SPDX-License-Identifier: MIT
#include "device/device_choice.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace bvhbench {
namespace {

std::string lower(std::string_view text)
{
    std::string out(text);
    for (char& c : out)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

bool has_all_words(const std::string& name, const std::string& words)
{
    std::istringstream stream(words);
    for (std::string word; stream >> word;)
        if (name.find(word) == std::string::npos)
            return false;
    return true;
}

}  // namespace

std::vector<std::size_t> matching_devices(std::span<const NamedDevice> devices,
                                          std::string_view words)
{
    const auto all_that = [&](const auto& fits) {
        std::vector<std::size_t> all;
        for (std::size_t k = 0; k < devices.size(); ++k)
            if (fits(devices[k]))
                all.push_back(k);
        return all;
    };
    const auto all_of = [&](cl_device_type type) {
        return all_that([&](const NamedDevice& device) { return (device.type & type) != 0; });
    };
    const std::string wanted = lower(words);
    if (wanted.empty()) {
        for (const cl_device_type type : {CL_DEVICE_TYPE_GPU, CL_DEVICE_TYPE_CPU})
            if (std::vector<std::size_t> all = all_of(type); !all.empty())
                return all;
        return all_that([](const NamedDevice&) { return true; });
    }
    if (wanted == "gpu" || wanted == "cpu")
        return all_of(wanted == "gpu" ? CL_DEVICE_TYPE_GPU : CL_DEVICE_TYPE_CPU);
    if (wanted.size() < 4 &&
        std::ranges::all_of(wanted, [](unsigned char c) { return std::isdigit(c) != 0; })) {
        const std::size_t index = std::stoul(wanted);
        return index < devices.size() ? std::vector{index} : std::vector<std::size_t>{};
    }
    return all_that(
        [&](const NamedDevice& device) { return has_all_words(lower(device.name), wanted); });
}

std::size_t chosen_device(std::span<const NamedDevice> devices, std::string_view words)
{
    const std::vector<std::size_t> matching = matching_devices(devices, words);
    return matching.empty() ? devices.size() : matching.front();
}

}  // namespace bvhbench
