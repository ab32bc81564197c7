// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "builders/builder.h"

namespace bvhbench {

/// What a query does with the front.
enum class FrontStep {
    generate,  ///< starts at the roots of a new tree and writes the first front
    keep,      ///< tests what is below the entries, and leaves the front as it is
    maintain,  ///< also writes the next front: entries sprout and climb
};

/// Decides what each frame of front tracking does, from what the frame before it found.
class FrontPlan {
public:
    FrontStep step() const { return step_; }
    bool writes() const { return step_ != FrontStep::keep; }
    std::uint32_t standing() const { return standing_; }  ///< entries of the current front
    std::uint64_t restarts() const { return restarts_; }

    /// Forgets everything: the next query is of a first frame.
    void reset() { *this = {}; }

    /// Records a complete query: the entries that it wrote, and the boxes that it tested below entries of the current front.
    void complete(std::uint32_t written, std::uint64_t descents) { last_ = {written, descents}; }

    /// The last query has to be repeated.
    void incomplete() { last_.reset(); }

    /// True if the next call of next_frame makes the front that was written the current one.
    bool exchanges() const { return last_ && writes(); }

    /// Moves to the next frame.
    TreeUpdate next_frame()
    {
        if (!last_)
            return start_again();
        const FrontStep step = step_;
        if (exchanges()) {
            standing_ = last_->written;
            kept_ = 0;
        }
        const double size = standing_, descents = static_cast<double>(last_->descents);
        last_.reset();
        if (step == FrontStep::generate)
            after_build_ = size;
        if (step == FrontStep::maintain && size > growth_to_restart * after_build_) {
            ++restarts_;
            return start_again();
        }
        const bool has_moved =
            step != FrontStep::generate && descents > descents_to_maintain * size;
        step_ = has_moved || ++kept_ == frames_to_maintain ? FrontStep::maintain : FrontStep::keep;
        return TreeUpdate::refit;
    }

private:
    /// A front is kept until a frame tests more boxes below its entries than this share of them, or for frames_to_maintain frames:
    /// if objects part, nothing is tested below entries, but they are deeper than they need to be.
    static constexpr double descents_to_maintain = 0.5;
    static constexpr std::uint32_t frames_to_maintain = 16;

    /// Refitted boxes become loose, and the front grows with them. If a front just maintained exceeds this multiple of the front
    /// after the last build, the tree is rebuilt and the front starts from the roots. Contacts let the front grow as well; the
    /// front after the rebuild is then the new reference, so that contacts cost a few builds rather than one per frame.
    static constexpr double growth_to_restart = 2;

    struct Frame {
        std::uint32_t written;
        std::uint64_t descents;
    };

    TreeUpdate start_again()
    {
        step_ = FrontStep::generate;
        standing_ = kept_ = 0;
        return TreeUpdate::rebuild;
    }

    FrontStep step_ = FrontStep::generate;
    std::uint32_t standing_ = 0;
    std::uint32_t kept_ = 0;     ///< frames since the front was written
    double after_build_ = 0;     ///< entries of the first front since the last build
    std::optional<Frame> last_;  ///< of the frame's last query, if it was complete
    std::uint64_t restarts_ = 0;
};

}  // namespace bvhbench
