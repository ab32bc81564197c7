// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace bvhbench {

/// One line on stderr that says where a long run is; silent unless stderr is a terminal.
class Progress {
public:
    explicit Progress(std::size_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// The next of `total` things has begun.
    void step(const std::string& what);

    /// The same thing goes on with something else.
    void note(const std::string& what) const;

private:
    std::size_t total_;
    std::size_t done_ = 0;
    bool is_shown_;
};

}  // namespace bvhbench
