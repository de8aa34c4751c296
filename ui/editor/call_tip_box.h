// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"

#include <QObject>

namespace carom {

/// Shows what the list one is writing in takes, above the line, with the parameter at the caret marked. Once
/// asked for it follows the caret until Esc or until the caret leaves the list.
class CallTipBox : public QObject {
    Q_OBJECT
  public:
    explicit CallTipBox(SceneEditor& editor);

    /// False where no list is open at the caret.
    bool show();
    bool isShown() const;
    void setTheme(const Theme& theme);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    bool refresh();

    SceneEditor& m_editor;
    bool m_wanted = false;
};

} // namespace carom
