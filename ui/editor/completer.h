// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"

#include "core/language/completion.h"

#include <QObject>

namespace carom {

/// Offers what may stand at the caret, as one types and on demand, each entry with its line of help beside
/// the list. What may stand there is core's to say; this only shows it.
class Completer : public QObject {
    Q_OBJECT
  public:
    explicit Completer(SceneEditor& editor);

    /// Shows the list now, even between words.
    void complete();

  private:
    void completeWhileTyping(int character);
    void offer(const CompletionList& list);
    void narrow();
    void close();
    void explain(const QByteArray& name);

    SceneEditor& m_editor;
    CompletionList m_offered;
};

} // namespace carom
