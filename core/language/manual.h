// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace carom {

/// The reference of the scene language as Markdown, made from the schema and the table of diagnostics. It is
/// kept in resources/help/language.md; a test compares.
std::string languageManual();

} // namespace carom
