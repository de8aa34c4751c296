// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/options.h"

#include <span>
#include <string>
#include <string_view>

// The files of a study that is made in parts (`--shard I/N`), and how they become those of the whole.

namespace carom {

/// "stability-2-of-8.csv" for "stability.csv"; the whole keeps its name.
std::string nameOfPart(std::string_view file, const Shard& shard);

/// `--merge DIR`.
OptionRow mergeOption();
/// Makes each table of its parts in the folder: the rows of the first, then of the second, ... A table
/// without any parts is left alone. Throws UsageError where there are none at all, FileError where some are
/// missing, or where parts of different numbers stand beside each other.
void mergeParts(const std::string& folder, std::span<const std::string_view> tables);

} // namespace carom
