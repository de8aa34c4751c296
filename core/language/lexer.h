// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic_list.h"
#include "core/base/work_stage.h"
#include "core/language/token.h"

#include <string_view>
#include <vector>

namespace carom {

/// Splits a text into tokens, comments included, white space left out; the last is always EndOfText. Any
/// bytes are taken. A run of bytes that begin no token is reported once: by itself it becomes an Invalid
/// token; where it touches a name or a number, all of that becomes one Faulty token, so that `größe` is one
/// mistake and not three. A number that does not end where a number may end is a Faulty token too.
///
/// As in the reference a name may follow a number without a space: `1mass` is a number and a name.
std::vector<Token> lex(std::string_view text, DiagnosticList& diagnostics, const WorkStage& stage = {});

} // namespace carom
