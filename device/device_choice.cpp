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

std::size_t chosen_device(std::span<const NamedDevice> devices, std::string_view words)
{
    const auto first_that = [&](const auto& fits) -> std::size_t {
        return static_cast<std::size_t>(std::ranges::find_if(devices, fits) - devices.begin());
    };
    const auto first_of = [&](cl_device_type type) {
        return first_that([&](const NamedDevice& device) { return (device.type & type) != 0; });
    };
    const std::string wanted = lower(words);
    if (wanted.empty()) {
        for (const cl_device_type type : {CL_DEVICE_TYPE_GPU, CL_DEVICE_TYPE_CPU})
            if (const std::size_t first = first_of(type); first < devices.size())
                return first;
        return 0;
    }
    if (wanted == "gpu" || wanted == "cpu")
        return first_of(wanted == "gpu" ? CL_DEVICE_TYPE_GPU : CL_DEVICE_TYPE_CPU);
    if (wanted.size() < 4 &&
        std::ranges::all_of(wanted, [](unsigned char c) { return std::isdigit(c) != 0; }))
        return std::min<std::size_t>(std::stoul(wanted), devices.size());
    return first_that(
        [&](const NamedDevice& device) { return has_all_words(lower(device.name), wanted); });
}

}  // namespace bvhbench
