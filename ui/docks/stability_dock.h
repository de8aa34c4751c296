// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/stability.h"
#include "ui/base/study_runner.h"
#include "ui/base/theme.h"
#include "ui/base/panel.h"

#include <optional>

class QCheckBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace carom {

/// The hard cases in a table: what is right, and in every column the verdict with the figure that decides;
/// below a case all its figures. They run on a thread of their own, all or those selected, and can be
/// stopped; what was measured stays. Activating a case opens it as a scene.
class StabilityDock : public Panel {
    Q_OBJECT
  public:
    explicit StabilityDock(const Theme& theme, QWidget* parent = nullptr);

    void setTheme(const Theme& theme) override;
    /// Runs these cases; nothing happens while others run.
    void run(std::vector<const HardCase*> cases);
    bool isRunning() const { return m_runner.isRunning(); }
    /// Every trial so far, a row a figure (figuresAsCsv). Returns what went wrong, or an empty text.
    QString exportTo(const QString& path) const override;

  Q_SIGNALS:
    /// A case is to be looked at: the text of its scene.
    void sceneWanted(const QString& name, const QByteArray& text);

  private:
    void fillCases();
    void startOrStop();
    StudyRunner::Finish work(const std::stop_token& stop, const StabilityPlan& plan);
    void take(const TrialResult& result);
    void showResult(const TrialResult& result);
    void finish(bool complete);
    void updateControls();
    QTreeWidgetItem* itemOf(const HardCase& hardCase) const;
    void open(QTreeWidgetItem* item, int column);

    Theme m_theme;
    QPushButton* m_button;
    QPushButton* m_export;
    QCheckBox* m_long;
    QProgressBar* m_progress;
    QLabel* m_state;
    QTreeWidget* m_table;
    StabilityStudy m_study; ///< the newest trial of each case and column
    StudyRunner m_runner;   ///< last: its study ends before what it speaks to
};

} // namespace carom
