// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"

#include <QObject>

namespace carom {

/// Closes braces as one types: behind `{` stands `}`. Typing it there only steps over it, Backspace between
/// the two takes both away, and Enter puts them on lines of their own. In a comment, before a word, and at
/// several carets a brace is a letter like any other.
class BraceTyping : public QObject {
    Q_OBJECT
  public:
    explicit BraceTyping(SceneEditor& editor);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void typed(int character);
    bool stepsOver();
    bool takesBoth();
    bool opensLines();
    /// Of the brace that was put there and is at the caret.
    bool isOurs(std::int64_t place) const;

    SceneEditor& m_editor;
};

} // namespace carom
