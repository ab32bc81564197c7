// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace re2 {
class RE2;
}

namespace bvhbench {

/// A regular expression that a user gave, in the syntax of RE2. It is read and matched in time that is linear in the length
/// of the texts, whatever it is.
class Pattern {
public:
    /// `option` is what the user named it by. Throws BadUsage if it is no regular expression.
    Pattern(const std::string& text, const std::string& option);

    /// Whether some part of `text` matches.
    bool is_in(const std::string& text) const;

private:
    std::shared_ptr<const re2::RE2> expression_;  // shared by copies: it does not change
};

}  // namespace bvhbench
