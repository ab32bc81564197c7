// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "python/arrays.h"
#include "python/open_device.h"

namespace bvhbench::python {

/// What is asked of a tree.
struct Query {
    std::string answer;               ///< pairs, contacts, within or first
    std::string among;                ///< all, between or within
    Numbers excluded, groups, masks;  ///< as oibvh::Filter
    double distance = 0;              ///< of `within`
};

/// Returns the pairs that the tree answers with, a row each; of `first` one row, or none. Releases the GIL. Throws oibvh::Error.
Numbers ask(const OpenDevice& on, oibvh::Tree& tree, const Query& query);

/// Returns the pairs of a query in a new array, a row each. Releases the GIL for the copy. Throws oibvh::Error.
Numbers array_of(const OpenDevice& on, const oibvh::Pairs& found);

}  // namespace bvhbench::python
