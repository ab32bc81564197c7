// SPDX-License-Identifier: MIT
//
// What a sweep measures: the product of scenes, sizes, builders, orders, colliders and options. docs/sweeps.md tells how it
// is written.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/collide.h"
#include "harness/json_keys.h"

namespace bvhbench {

/// One of the product: a builder, or a collider over its trees, on a scene.
struct SweepCell {
    Json scene;  ///< an object of `scene` and what else experiments of whole frames say of one
    BuilderChoice builder;       ///< called none if the collider wants no tree
    ColliderChoice collider;     ///< of an empty name: the cell is a build
    std::int64_t triangles = 0;  ///< as far as the scene's name tells; else 0
    std::string why_not = {};    ///< why there is no such cell; then it is skipped

    std::string scene_name() const { return scene.at("scene").get<std::string>(); }
    bool collides() const { return !collider.name.empty(); }
    bool operator==(const SweepCell&) const = default;
};

/// Read from JSON, where all but scenes and one of builders and colliders may be left out:
///
///     {"sweep": "sizes", "question": "...",
///      "scenes": ["torus", "refine:bunny:{size}", "dragon", {"scene": "cloth-ball", "frames": "0:4"}],
///      "sizes": "1000:1000000:x10", "builders": ["karras", {"name": "oibvh-multi", "items": 4}],
///      "orders": ["morton30", "hilbert30"], "colliders": ["leaf", {"name": "bvtt", "jump": 2}],
///      "set": {"boxes": ["f32", "u16"], "narrow": ["none", "exact"]},
///      "samples": 20, "warm_up": 3, "quality": true}
struct Sweep {
    std::string name = "sweep";  ///< the cells' experiment
    std::string question;
    int samples = 20;
    int warm_up = 3;
    bool quality = false;
    std::vector<SweepCell> cells;  ///< each once, scene by scene
    std::string product;           ///< "2 scenes x 3 builders"
};

/// Throws BadUsage, in a sentence that names the key, for what makes no sense, and what reading JSON does. A combination that cannot be, of things that
/// can, is a cell that says why not.
Sweep sweep_of(const Json& json);

}  // namespace bvhbench
