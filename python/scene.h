// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>

#include "python/query.h"

namespace bvhbench::python {

/// A scene over copies of arrays. Threads may call one scene: calls take turns.
class BoundScene {
public:
    BoundScene(std::shared_ptr<OpenDevice> on, oibvh::Options options);

    std::uint32_t add(const Floats& points, const Numbers& faces);

    /// `pose` has 3 rows of 4.
    void place(std::uint32_t object, const Floats& pose);
    void move(std::uint32_t object, const Floats& points);

    Numbers ask(const Query& query);

    /// Returns the bytes of device memory that the scene holds.
    std::size_t memory();

private:
    template <class Work>
    auto in_turn(Work&& work);

    std::shared_ptr<OpenDevice> on_;
    std::mutex mutex_;
    oibvh::Scene scene_;
};

}  // namespace bvhbench::python
