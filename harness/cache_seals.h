// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace bvhbench {

/// Seals on the files of PoCL's cache: what each was when a run that used it ended.
///
///     folder/XX/<hash>/program.bc                  a program, PoCL's
///     folder/XX/<hash>/<kernel>/<sizes>/<kernel>.so
///     folder/bvhbench.seals                        a line a file: sum, bytes, path
///
/// PoCL looks at nothing that it reads back: a file cut short or overwritten ends the process, or computes something
/// else. A program one of whose files has no seal, or another content, is removed, to be compiled anew.

/// Remove what is not as it was sealed, and then the programs used longest ago until all take no more than
/// `most_bytes`. Nobody else may use the folder meanwhile. Whether all that had to go is gone.
bool remove_broken(const std::filesystem::path& folder, std::uintmax_t most_bytes);

/// Seal what is there. Others may add files meanwhile; of two who seal at a time the later one's holds. What cannot be
/// written is left out: files without a seal are compiled again, no more.
void seal(const std::filesystem::path& folder) noexcept;

}  // namespace bvhbench
