// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"

#include "core/language/navigation.h"

#include <QFrame>

class QLabel;
class QLineEdit;

namespace carom {

/// A line over a label in which one writes its new name. What cannot be a name is said as one types; Enter
/// renames the label wherever it stands, in one undo step; Esc gives up.
class RenameBox : public QFrame {
    Q_OBJECT
  public:
    explicit RenameBox(SceneEditor& editor);

    /// False where no label is at the caret.
    bool begin();

  protected:
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

  private:
    Rename renamed() const;
    void judge();
    void apply();
    void close();

    SceneEditor& m_editor;
    QLineEdit* m_name;
    QLabel* m_refusal;
    Analysis m_analysis;
    std::uint32_t m_place = 0;
};

} // namespace carom
