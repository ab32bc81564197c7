// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace bvhbench {

/// How long cells that are not done will take, from those that are: a time to start and one for each triangle, of the same
/// builder or pipeline if it is done in several sizes, else of all.
class TimeLeft {
public:
    /// What a process costs before it measures anything, in triangles: a guess where nothing is known yet.
    static constexpr double start_triangles = 100000;

    /// A cell of `kind`, so many triangles (0: not known) and seconds.
    void add(const std::string& kind, std::int64_t triangles, double seconds);

    /// Whether there is anything to go by.
    bool knows() const { return !all_.empty(); }

    /// It must know something.
    double seconds_of(const std::string& kind, std::int64_t triangles) const;

private:
    struct Done {
        double triangles, seconds;
    };
    static bool has_sizes(const std::vector<Done>& done);
    static double estimate(const std::vector<Done>& done, double triangles);

    std::vector<Done> all_;
    std::map<std::string, std::vector<Done>> of_kind_;
};

/// "12 s", "3 min", "5 h 20 min", "2 d 3 h".
std::string rough_time(double seconds);

}  // namespace bvhbench
