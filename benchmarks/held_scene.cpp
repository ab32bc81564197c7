// SPDX-License-Identifier: MIT
#include "benchmarks/held_scene.h"

#include "harness/base/failure.h"
#include "harness/base/terminal.h"

namespace bvhbench {

HeldScene::HeldScene(const std::function<void()>& measure)
{
    Engine::other_sampler = [this](std::span<Subject> cells) {
        if (leaves_)
            return;
        {
            const Progress cleared(0);  // its end clears the line, so that results begin one
        }
        cells_ = cells;
        settled_.release();
        sampled_.acquire();
    };
    thread_ = std::thread([this, measure] {
        failure_ = reason_of_failure(measure);
        cells_ = {};
        settled_.release();
    });
    settled_.acquire();
}

HeldScene::~HeldScene()
{
    leaves_ = true;
    sampled_.release();
    thread_.join();
    Engine::other_sampler = {};
}

void HeldScene::go_on()
{
    sampled_.release();
    settled_.acquire();
}

}  // namespace bvhbench
