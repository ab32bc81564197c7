// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

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

/// Whether `text` has `part` in it; a failure shows both.
inline testing::AssertionResult contains(const std::string& text, const std::string& part)
{
    if (text.find(part) != text.npos)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << "'" << text << "' lacks '" << part << "'";
}

}  // namespace bvhbench
