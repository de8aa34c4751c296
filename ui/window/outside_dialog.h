// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QDialog>
#include <QString>

namespace carom {

struct Theme;

/// Two texts want one file: this one, and what another program has written into it. Shows what differs and
/// asks which of them stays.
class OutsideDialog : public QDialog {
    Q_OBJECT
  public:
    enum Answer { KeepBoth = QDialog::Rejected, TakeTheFiles, SaveThis };

    struct Texts {
        QString name;         ///< of the file
        QByteArray here;      ///< in the editor
        QByteArray inTheFile; ///< by the other program
    };

    /// `saving`: the user is about to write this text over the file's.
    OutsideDialog(const Texts& texts, bool saving, const Theme& theme, QWidget* parent);
};

} // namespace carom
