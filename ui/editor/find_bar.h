// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"
#include "ui/editor/text_search.h"

#include <QThreadPool>
#include <QWidget>

#include <atomic>
#include <memory>
#include <vector>

class QCheckBox;
class QLabel;
class QLineEdit;

namespace carom {

/// One undo step; how many were replaced.
int replaceAllMatches(SceneEditor& editor, const SearchQuery& query, const QString& replacement);

/// Find and replace, below the editor. Searches as one types; Enter and Shift+Enter go on, Esc closes. All
/// matches are marked, and counted beside the GUI thread where the text is long.
class FindBar : public QWidget {
    Q_OBJECT
  public:
    explicit FindBar(SceneEditor& editor, QWidget* parent = nullptr);
    ~FindBar() override;

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
    void count(const QByteArray& text);
    void take(std::vector<SourceRange> matches);
    void forgetMatches();
    void sayWhich();
    SourceRange selection() const;
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
    QString m_wrapped;         ///< that the search went on from the other end
    SearchQuery m_counted;     ///< what the matches are of
    std::vector<SourceRange> m_matches;
    std::shared_ptr<std::atomic<bool>> m_counting; ///< false ends it; null: nobody counts
    QThreadPool m_counter;
};

} // namespace carom
