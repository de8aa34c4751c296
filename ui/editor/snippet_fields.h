// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"

#include "core/language/snippet.h"

#include <QObject>

namespace carom {

/// Declarations inserted whole, to be filled in: Tab goes from value to value, Esc or leaving the declaration
/// ends that. The values one has not visited yet are boxed.
class SnippetFields : public QObject {
    Q_OBJECT
  public:
    explicit SnippetFields(SceneEditor& editor);

    /// Expands the type's name in front of the caret, or offers all types.
    void insertOrOffer();
    bool isFilling() const { return m_filling; }
    void setTheme(const Theme& theme);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    bool expand();
    void insert(const QByteArray& type, SourceRange replaced);
    void insertChosen(const QByteArray& type);
    bool goToField(bool forward);
    void end();

    SceneEditor& m_editor;
    bool m_filling = false;
};

} // namespace carom
