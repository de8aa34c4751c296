// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QString>

namespace carom {

/// Writes a whole file, aside and renamed. Returns what went wrong as a sentence, or an empty text.
QString writeText(const QString& path, const QByteArray& text);
inline QString writeText(const QString& path, const std::string& text) {
    return writeText(path, QByteArray::fromStdString(text));
}

} // namespace carom
