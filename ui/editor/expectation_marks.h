// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/base/theme.h"
#include "ui/editor/check_rows.h"
#include "ui/editor/scene_editor.h"

#include <QObject>

#include <cstdint>
#include <vector>

namespace carom {

class LineMessages;

/// A mark in the margin beside every `expect`: a ring before it is judged, a tick while it holds, a cross
/// where it has failed. What was measured there stands under the line, where messages stand; the mouse over a
/// mark tells it of all.
class ExpectationMarks : public QObject {
    Q_OBJECT
  public:
    ExpectationMarks(SceneEditor& editor, LineMessages& messages, const Theme& theme);

    /// Of the text that is in the editor.
    void show(std::vector<CheckRow> rows);
    void setTheme(const Theme& theme);

  Q_SIGNALS:
    /// A click on the mark of one that has failed.
    void failureClicked(std::int64_t frame);

  private:
    const CheckRow* rowAt(long line) const;
    void showHover(int position, int x, int y);
    void click(int margin, int line);

    SceneEditor& m_editor;
    LineMessages& m_messages;
    std::vector<CheckRow> m_rows;
};

/// "did not hold: 10 m/s, at most 5, by `ball`, at 1 s", "holds: exact".
QString wordsOf(const CheckRow& row);

} // namespace carom
