// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/sweep.h"
#include "ui/editor/live_build.h"

#include <QString>
#include <QWidget>

#include <optional>

class QCheckBox;
class QPlainTextEdit;
class QSpinBox;
class QToolButton;

namespace carom {

/// What a sweep varies and measures, as one fills it in: the texts of `carom sweep`, one a line, and counts.
class SweepForm : public QWidget {
    Q_OBJECT
  public:
    explicit SweepForm(QWidget* parent = nullptr);

    /// The scene to sweep. Its `sweep` declaration fills the form where it is new; a file that is opened
    /// without one empties it.
    void setScene(const SharedBuild& build);
    /// Values for what a path leads to ("cue.vel.x"), and a measure where none was chosen. `together`: beside
    /// what is varied already.
    void propose(const QString& path, bool together);
    /// The only path that is varied so far; empty where there is none, or several.
    QString onlyPath() const;
    SweepDefinition definition() const;
    /// Whether something that the scene's `sweep` declaration switches on is off here: what is said beside a
    /// declaration only adds to it.
    bool leavesDeclarationAside() const;
    /// Whether something is varied and something measured.
    bool isFilled() const;

  Q_SIGNALS:
    void changed();

  private:
    void fill(const SweepDefinition& definition);
    void fillMeasures();
    void takeMeasure(const QString& measure);

    SharedBuild m_build;
    std::optional<SweepDefinition> m_declared; ///< what the text says
    QString m_proposedMeasure;                 ///< in the form since it was proposed; empty where it was not
    QString m_proposedPath;                    ///< what measures are proposed for
    QPlainTextEdit *m_vary, *m_measures;       ///< one a line
    QToolButton* m_choose;                     ///< a measure
    QCheckBox* m_zip;
    QSpinBox *m_frames, *m_seeds, *m_random;
};

} // namespace carom
