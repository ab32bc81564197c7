// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "builders/input.h"
#include "device/program.h"

namespace bvhbench {

/// The kernel of the stage `bounds` that makes boxes from points, in its two programs: of one frame, and swept from one
/// to the next (SWEPT of bounds_parts.clh), which is compiled when an input first asks for it.
class BoxKernels {
public:
    BoxKernels(Programs& programs, std::string_view path, const char* name,
               std::vector<Define> defines);

    /// The one for such an input, its points and then `more` bound to it.
    template <class... Arguments>
    cl::Kernel& bound(const Input& input, const Arguments&... more)
    {
        return input.is_swept()
                   ? set_arguments(swept(), input.device_points, input.device_end_points, more...)
                   : set_arguments(of_frame_, input.device_points, more...);
    }

private:
    cl::Kernel compiled(unsigned is_swept);
    cl::Kernel& swept();

    Programs& programs_;
    std::string_view path_;
    const char* name_;
    std::vector<Define> defines_;
    cl::Kernel of_frame_;
    std::optional<cl::Kernel> swept_;
};

}  // namespace bvhbench
