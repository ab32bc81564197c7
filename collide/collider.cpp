// SPDX-License-Identifier: MIT
#include "collide/collider.h"

namespace bvhbench {

int find_pairs(Collider& collider, const Tree* tree, const Input& input, Queue& queue)
{
    for (int queries = 1;; ++queries) {
        collider.query(tree, input, queue);
        if (collider.complete(queue))
            return queries;
    }
}

}  // namespace bvhbench
