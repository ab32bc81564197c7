// SPDX-License-Identifier: MIT
#include "builders/builder.h"

#include <cassert>

namespace bvhbench {

std::vector<TreeUpdate> Builder::plan_update(std::span<const TreeUpdate> wanted, Queue&)
{
    update_ = update_of_all(wanted, can_refit());
    return std::vector<TreeUpdate>(wanted.size(), update_);
}

const Tree& Builder::update(const Input& input, Queue& queue)
{
    assert(update_ != TreeUpdate::keep);
    return update_ == TreeUpdate::refit ? refit(input, queue) : build(input, queue);
}

}  // namespace bvhbench
