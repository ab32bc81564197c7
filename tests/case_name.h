// SPDX-License-Identifier: MIT
//
// Names of the cases of parameterized tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <tuple>

#include "builders/stages/kernel_form.h"

namespace bvhbench {

/// Replaces by `_` what GoogleTest does not allow in a name: all but letters and digits.
inline std::string test_name(std::string name)
{
    std::ranges::replace_if(
        name, [](unsigned char letter) { return std::isalnum(letter) == 0; }, '_');
    return name;
}

inline std::string name_of(std::string_view name) { return test_name(std::string(name)); }
inline std::string name_of(KernelForm form)
{
    return form == KernelForm::groups ? "groups" : "chunks";
}
template <class Entry>
requires requires(const Entry& entry) { entry.name; }
std::string name_of(const Entry& entry) { return name_of(std::string_view(entry.name)); }

/// Names a case of a parameterized test by its parameters, in order.
struct CaseName {
    template <class... Parts>
    std::string operator()(const testing::TestParamInfo<std::tuple<Parts...>>& tested) const
    {
        std::string name;
        std::apply([&](const Parts&... parts) { ((name += name_of(parts) + '_'), ...); },
                   tested.param);
        return name.substr(0, name.size() - 1);
    }
    template <class Part>
    std::string operator()(const testing::TestParamInfo<Part>& tested) const
    {
        return name_of(tested.param);
    }
};

}  // namespace bvhbench
