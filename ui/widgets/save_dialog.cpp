// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/save_dialog.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QRegularExpression>

namespace carom {
namespace {

QString& lastFolder() {
    static QString folder; // empty: the program's working directory
    return folder;
}

} // namespace

QString askWhereToSave(QWidget* parent, const QString& title, const QString& name, const QString& filters) {
    QString filter;
    QString path =
        QFileDialog::getSaveFileName(parent, title, QDir(lastFolder()).filePath(name), filters, &filter);
    if (path.isEmpty()) return path;
    static const QRegularExpression ending(QStringLiteral("\\*(\\.\\w+)"));
    if (QFileInfo(path).suffix().isEmpty()) path += ending.match(filter).captured(1);
    rememberFolderOf(path);
    return path;
}

void rememberFolderOf(const QString& path) { lastFolder() = QFileInfo(path).absolutePath(); }

} // namespace carom
