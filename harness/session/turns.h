// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>

namespace bvhbench {

/// Several runs, of several builds of this program, that sample at the same time by turns, a round each: whatever the
/// machine does hits them alike, which runs one after the other cannot have. They meet by a file that all of them name.
///
///     file    a line a run, meeting and parting, the run's id; and a lock, held by whose turn it is
class Turns {
public:
    /// Turns among `count` runs, of which this one is called `id`. Throws BadUsage if others have used the file up before.
    Turns(std::string path, int count, std::string id);
    ~Turns();
    Turns(const Turns&) = delete;
    Turns& operator=(const Turns&) = delete;

    /// Wait until all have come: before the samples of each scene. Throws Unavailable after two minutes.
    void meet();

    /// Wait until all have taken their samples, so that what comes after disturbs none of them: after the samples of each
    /// scene. No longer than two minutes: what was measured is worth more.
    void part();

    /// While it lives, the others wait. Whoever ends, however, gives it back.
    class Turn {
    public:
        explicit Turn(Turns* turns);
        ~Turn();
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        Turns* turns_;
    };

    /// Runs met, without this one.
    const std::set<std::string>& others() const { return others_; }

private:
    /// Whether all came within two minutes.
    bool all_come();

    std::string path_;
    int count_;
    std::string id_;
    int descriptor_ = -1;
    int meetings_ = 0;
    std::set<std::string> others_;
};

}  // namespace bvhbench
