// SPDX-License-Identifier: MIT
//
// The option `exclude` of a scene: words separated by `;`, each a pair of objects "A,B", or "@FILE", a text file of lines
//
//     exclude A B            pairs of objects A and B are not tested; A A: nor those within A
//     group A WORD MASK      bits of what A is, and of what it is tested against, in decimal or as 0x...
//
// Empty lines and what follows # are passed over. An object is called by its name, or by its number in the scene's file.
#pragma once

#include <string>
#include <string_view>

#include "collide/object_filter.h"
#include "scenes/scene.h"

namespace bvhbench {

/// Adds words to those that are there. Returns false if one of them is neither a pair nor a file.
bool add_exclude_words(std::string& exclude, std::string_view words);

/// Returns the filter of the words for a scene. Throws BadUsage for an object that the scene does not have, for a name of several of its
/// objects, and for a line that is neither of the two; Unavailable for a file that cannot be read.
ObjectFilter filter_of(const std::string& exclude, const Scene& scene);

}  // namespace bvhbench
