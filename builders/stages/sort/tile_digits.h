// SPDX-License-Identifier: MIT
#pragma once

#include "device/program.h"

namespace bvhbench {

/// What the sorts by groups are compiled with and their host sides count with.
inline constexpr uint tile_digit_bits = 8;  ///< bits that a pass sorts by
inline constexpr uint tile_digits = 1u << tile_digit_bits;
inline constexpr uint most_tile_passes = 64 / tile_digit_bits;

/// Bits of a look-back state that number its epoch (look_back.clh). Epoch 0 is that of cleared states.
inline constexpr uint state_epoch_bits = 31;
inline constexpr uint last_epoch = (1u << state_epoch_bits) - 1;

}  // namespace bvhbench
