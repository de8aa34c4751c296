// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/line_messages.h"
#include "ui/editor/live_build.h"
#include "ui/editor/scene_editor.h"

#include <QObject>

#include <optional>

namespace carom {

/// Shows what is wrong in the text where it is wrong: a squiggle on the exact bytes, a mark in the margin,
/// the message under the line (switchable) and under the mouse. Knows the way to the next problem and applies
/// fix-its.
class DiagnosticMarks : public QObject {
    Q_OBJECT
  public:
    DiagnosticMarks(SceneEditor& editor, const Theme& theme);

    void show(const SharedBuild& result);
    void setTheme(const Theme& theme);
    void setInlineMessages(bool shown) { m_messages.setShown(shown); }
    /// Where others say something under a line, too.
    LineMessages& messages() { return m_messages; }

    void goToNext();
    void goToPrevious();
    /// The fix-it of the problem at the caret, or of the caret's line.
    const Diagnostic* fixableAtCaret() const;
    /// False where there is nothing to correct or the text has changed since it was checked.
    bool applyFixIt(std::int64_t revision);

  private:
    void showHover(int position, int x, int y);
    QStringList helpAt(std::uint32_t position) const;
    const std::vector<Diagnostic>& diagnostics() const;

    SceneEditor& m_editor;
    LineMessages m_messages;
    SharedBuild m_result;
};

} // namespace carom
