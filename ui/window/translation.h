// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <span>

class QCoreApplication;

namespace carom {

/// A language the IDE speaks.
struct LanguageRow {
    const char* code;    ///< ISO 639-1
    const char* ownName; ///< UTF-8
};

/// English, which the texts are written in, first.
std::span<const LanguageRow> languages();

/// Makes the application speak the language of that code; empty: the system's, where there is a translation.
/// What was installed before is given up; texts that are shown already stay as they are.
void installTranslation(QCoreApplication& application, const QString& code);

} // namespace carom
