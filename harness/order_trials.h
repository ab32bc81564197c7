// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace bvhbench {

/// In which frames the order of leaves is tried before they are sorted. Where it does not hold, trying it is lost; so
/// after each time in a row that it did not, twice as many frames go by without.
class OrderTrials {
public:
    static constexpr int longest_pause = 64;

    /// A frame begins whose leaves are lined up: whether to try.
    bool next()
    {
        is_trying_ = left_ == 0;
        left_ -= is_trying_ ? 0 : 1;
        return is_trying_;
    }

    /// Whether the last frame tried, which nobody has learnt from yet.
    bool is_trying() const { return is_trying_; }

    /// What came of that.
    void learn(bool held)
    {
        pause_ = held ? 0 : std::clamp(2 * pause_, 1, longest_pause);
        left_ = pause_;
        is_trying_ = false;
    }

private:
    bool is_trying_ = false;
    int pause_ = 0;  ///< frames without, after the last that tried
    int left_ = 0;   ///< of them
};

}  // namespace bvhbench
