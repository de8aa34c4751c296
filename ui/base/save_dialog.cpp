// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/save_dialog.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QRegularExpression>

namespace carom {
namespace {

struct SaveTexts {
    Q_DECLARE_TR_FUNCTIONS(Save)
};

QString& lastFolder() {
    static QString folder; // empty: the program's working directory
    return folder;
}

bool mayReplace(QWidget* parent, const QString& title, const QString& path) {
    QMessageBox box(QMessageBox::Warning, title,
                    SaveTexts::tr("“%1” exists already. Replace it?").arg(QFileInfo(path).fileName()),
                    QMessageBox::Yes | QMessageBox::No, parent);
    box.setTextFormat(Qt::PlainText); // a file may be called anything
    box.setDefaultButton(QMessageBox::No);
    return box.exec() == QMessageBox::Yes;
}

} // namespace

QString askWhereToSave(QWidget* parent, const QString& title, const QString& name, const QString& filters,
                       const Replaced& replaced) {
    QString proposed = QDir(lastFolder()).filePath(name);
    for (;;) {
        QString filter;
        // What is asked about is the file that will be written, with its ending: the dialog does not know it.
        QString path = QFileDialog::getSaveFileName(parent, title, proposed, filters, &filter,
                                                    QFileDialog::DontConfirmOverwrite);
        if (path.isEmpty()) return path;
        static const QRegularExpression ending(QStringLiteral("\\*(\\.\\w+)"));
        if (QFileInfo(path).suffix().isEmpty()) path += ending.match(filter).captured(1);
        rememberFolderOf(path);
        const QString old = replaced ? replaced(path) : QFileInfo::exists(path) ? path : QString();
        if (old.isEmpty() || mayReplace(parent, title, old)) return path;
        proposed = path;
    }
}

void rememberFolderOf(const QString& path) { lastFolder() = QFileInfo(path).absolutePath(); }

} // namespace carom
