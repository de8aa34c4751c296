// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/live_build.h"
#include "ui/window/theme.h"

#include <QDockWidget>

class QTextBrowser;

namespace carom {

class EmptyState;

/// Which effects the scene is simulated with, and the sentence why or why not; a link goes to the line that
/// calls for it.
class EffectsDock : public QDockWidget {
    Q_OBJECT
  public:
    explicit EffectsDock(const Theme& theme, QWidget* parent = nullptr);

    void show(const SharedBuild& result);
    void setTheme(const Theme& theme);

  Q_SIGNALS:
    void placeActivated(carom::SourceRange range);

  private:
    QString entry(const EffectDecision& decision, std::size_t number) const;
    void fill();

    Theme m_theme;
    SharedBuild m_result;
    QTextBrowser* m_text;
    EmptyState* m_state;
};

} // namespace carom
