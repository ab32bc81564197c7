// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string_view>

#include "cluster/frame.h"

namespace bvhbench {

/// Times the stages of a frame, one after the other.
class FrameClock {
public:
    /// Times the first `count` stages, and calls `begins` with the name of each when it begins.
    FrameClock(RankFrame& frame, std::size_t count,
               const std::function<void(std::string_view)>& begins)
        : frame_(frame), count_(count), begins_(begins)
    {
        begins_(frame_stages[0]);
    }

    /// Ends the next stage.
    void end_stage()
    {
        const std::int64_t now = now_ns();
        frame_.host_ns[stage_++] = now - last_;
        last_ = now;
        frame_.whole_ns = now - start_;
        if (stage_ < count_)
            begins_(frame_stages[stage_]);
    }

private:
    static std::int64_t now_ns()
    {
        using namespace std::chrono;
        return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
    }

    RankFrame& frame_;
    std::size_t count_;
    const std::function<void(std::string_view)>& begins_;
    std::size_t stage_ = 0;
    const std::int64_t start_ = now_ns();
    std::int64_t last_ = start_;
};

}  // namespace bvhbench
