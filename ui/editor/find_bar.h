// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/text_search.h"

#include <QWidget>

class QCheckBox;
class QLabel;
class QLineEdit;

namespace carom {

/// Find and replace, below the editor. Searches as one types; Enter and Shift+Enter go on, Esc closes.
class FindBar : public QWidget {
    Q_OBJECT
  public:
    explicit FindBar(SceneEditor& editor, QWidget* parent = nullptr);

    /// Shows the bar, filled with what is selected.
    void activate();
    void findNext();
    void findPrevious();

  protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    SearchQuery query() const;
    void search(std::int64_t from, bool forward);
    void searchWhileTyping();
    void replaceOne();
    void replaceAll();
    void close();
    void say(const QString& message, bool isProblem = false);

    SceneEditor& m_editor;
    QLineEdit* m_find;
    QLineEdit* m_replace;
    QCheckBox* m_regularExpression;
    QCheckBox* m_matchCase;
    QLabel* m_message;
    std::int64_t m_origin = 0; ///< where the search began
};

} // namespace carom
