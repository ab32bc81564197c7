// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <semaphore>
#include <span>
#include <string>
#include <thread>

#include "harness/measure/engine.h"

namespace bvhbench {

/// A call of the harness that waits where it would sample. The harness loads a scene, settles its cells and samples them in one
/// call, but Google Benchmark calls a function for each repetition of a cell, in any order. Therefore the call has a thread of its
/// own, which waits while the cells are sampled outside: only one of the two threads works at any time. One object may exist.
class HeldScene {
public:
    /// Begins the call and waits until it has settled cells or ended.
    explicit HeldScene(const std::function<void()>& measure);
    ~HeldScene();  ///< lets the call end
    HeldScene(const HeldScene&) = delete;
    HeldScene& operator=(const HeldScene&) = delete;

    /// Cells that were settled together, valid until go_on(); empty if the call has ended.
    std::span<Subject> cells() const { return cells_; }

    /// Waits until the call has settled its next cells or ended.
    void go_on();

    /// Why the call threw; empty if it did not.
    const std::string& failure() const { return failure_; }

private:
    std::span<Subject> cells_;
    std::string failure_;
    bool leaves_ = false;  ///< whether the call is to end without further waiting
    std::binary_semaphore settled_{0}, sampled_{0};
    std::thread thread_;
};

}  // namespace bvhbench
