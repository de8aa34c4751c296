// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/live_build.h"
#include "core/player/sample_queue.h"
#include "ui/base/theme.h"
#include "ui/base/panel.h"

#include <QTimer>

#include <deque>
#include <span>

class QTextBrowser;

namespace carom {

class EmptyState;

/// Which effects the scene is simulated with, and the sentence why or why not; a link goes to the line that
/// calls for it. Below them what a frame takes: effects share its passes, and those that are absent take
/// none.
class EffectsDock : public Panel {
    Q_OBJECT
  public:
    explicit EffectsDock(const Theme& theme, QWidget* parent = nullptr);

    void show(const SharedBuild& result);
    void addSamples(std::span<const FrameSample> samples);
    /// Another run begins: its frames count anew.
    void clear();
    void setTheme(const Theme& theme) override;

  Q_SIGNALS:
    void placeActivated(carom::SourceRange range);

  private:
    QString entry(const EffectDecision& decision, std::size_t number) const;
    QString frameTimes() const;
    void fill();

    Theme m_theme;
    SharedBuild m_result;
    std::deque<FrameSample> m_frames; ///< the newest
    QTimer m_refresh;
    QTextBrowser* m_text;
    EmptyState* m_state;
};

} // namespace carom
