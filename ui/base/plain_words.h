// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

// Names of files, which may hold anything, where Qt reads more than letters. Labels and message boxes that
// hold one have Qt::PlainText.

namespace carom {

/// For a tool tip, which Qt takes for HTML where it looks like that.
QString plainTip(const QString& text);

/// For a menu or a button, where `&` stands before the letter that chooses it.
QString plainTitle(const QString& text);

} // namespace carom
