// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace re2 {
class RE2;
}

namespace bvhbench {

/// A regular expression from the user, in RE2 syntax. Parsing and matching take time linear in the length of the texts, for every
/// expression.
class Pattern {
public:
    /// `option` is the command-line option, for messages. Throws BadUsage if `text` is not a regular expression.
    Pattern(const std::string& text, const std::string& option);

    /// True if any part of `text` matches.
    bool is_in(const std::string& text) const;

private:
    std::shared_ptr<const re2::RE2> expression_;  // copies share it: it is immutable
};

}  // namespace bvhbench
