// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/text_file.h"

#include <QCoreApplication>
#include <QSaveFile>

namespace carom {

QString writeText(const QString& path, const QByteArray& text) {
    QSaveFile file(path);
    if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit()) return {};
    return QCoreApplication::translate("carom", "`%1` cannot be written: %2").arg(path, file.errorString());
}

} // namespace carom
