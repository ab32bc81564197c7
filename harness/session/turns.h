// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>

namespace bvhbench {

/// Several runs, of several builds of this program, that sample at the same time and take turns, one round each. Drift of the
/// machine then affects all alike, unlike runs one after another. The runs meet through a file that each of them names.
///
///     file    one line for each meet() and part() of a run, with its id; and a lock, held by the run whose turn it is
class Turns {
public:
    /// Joins `count` runs as the run `id`. Throws BadUsage if the file was used before, and Unavailable if it cannot be written.
    Turns(std::string path, int count, std::string id);
    ~Turns();
    Turns(const Turns&) = delete;
    Turns& operator=(const Turns&) = delete;

    /// Waits until all runs call it, before the samples of a scene. Throws Unavailable after two minutes.
    void meet();

    /// Waits until all runs have taken the samples of a scene, so that the work after them disturbs no samples. Returns after two
    /// minutes at the latest, in order not to lose the samples.
    void part();

    /// One turn: the other runs wait while it exists. The system ends the turn of a process that ends. Does nothing for nullptr.
    class Turn {
    public:
        explicit Turn(Turns* turns);
        ~Turn();
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        Turns* turns_;
    };

    /// Returns the ids of the other runs met.
    const std::set<std::string>& others() const { return others_; }

private:
    /// Adds a line to the file and waits. True if all runs did so within two minutes.
    bool all_come();

    std::string path_;
    int count_;
    std::string id_;
    int descriptor_ = -1;
    int meetings_ = 0;
    std::set<std::string> others_;
};

}  // namespace bvhbench
