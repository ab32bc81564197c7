// SPDX-License-Identifier: MIT
#include "builders/stages/box_kernels.h"

namespace bvhbench {

BoxKernels::BoxKernels(Programs& programs, std::string_view path, const char* name,
                       std::vector<Define> defines)
    : programs_(programs)
    , path_(path)
    , name_(name)
    , defines_(std::move(defines))
    , of_frame_(compiled(0))
{}

cl::Kernel BoxKernels::compiled(unsigned is_swept)
{
    std::vector<Define> defines = defines_;
    defines.push_back({"SWEPT", is_swept});
    return programs_.kernel(path_, name_, defines);
}

cl::Kernel& BoxKernels::swept()
{
    if (!swept_)
        swept_ = compiled(1);
    return *swept_;
}

}  // namespace bvhbench
