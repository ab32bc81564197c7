// SPDX-License-Identifier: MIT
#include "harness/base/pattern.h"

#include <re2/re2.h>

#include "geometry/error.h"
#include "scenes/formats/text.h"

namespace bvhbench {
Pattern::Pattern(const std::string& text, const std::string& option)
    : expression_(std::make_shared<re2::RE2>(text, re2::RE2::Quiet))
{
    if (!expression_->ok())
        throw BadUsage(option + ": " + in_quotes(text) + " is no regular expression: " +
                       expression_->error().substr(0, expression_->error().find(':')));
}

bool Pattern::is_in(const std::string& text) const
{
    return re2::RE2::PartialMatch(text, *expression_);
}

}  // namespace bvhbench
