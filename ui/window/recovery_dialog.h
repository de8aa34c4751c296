// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/window/recovery.h"
#include "ui/base/theme.h"

#include <QDialog>

class QListWidget;

namespace carom {

class DifferenceView;

/// What crashed sessions left, each with what it changes in its file: one recovers a text, discards it, or
/// decides later.
class RecoveryDialog : public QDialog {
    Q_OBJECT
  public:
    enum Answer { Later = QDialog::Rejected, Recover = QDialog::Accepted, Discard };

    RecoveryDialog(std::vector<LostText> lost, const Theme& theme, QWidget* parent);

    const LostText& chosen() const;

  private:
    void showChosen();

    std::vector<LostText> m_lost;
    QListWidget* m_list;
    DifferenceView* m_difference;
};

} // namespace carom
