// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "geometry/error.h"

namespace bvhbench {

/// Returns the message of the Error that `work` throws; empty if it throws none.
template <class Error = Unavailable>
std::string refusal_of(const auto& work)
{
    try {
        work();
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

}  // namespace bvhbench
