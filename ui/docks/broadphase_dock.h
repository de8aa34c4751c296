// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/player/sample_queue.h"

#include "core/broadphase/broadphase.h"
#include "core/simulation/pipeline.h"
#include "ui/base/panel.h"

#include <QElapsedTimer>

#include <memory>
#include <span>
#include <vector>

class QComboBox;
class QGridLayout;
class QLabel;

namespace carom {

class BroadphaseComparison;

/// What the broad-phase does in the running scene, and which one does it; beside it, all of them compared.
/// Figures are those of the newest frame, refreshed a few times a second so that they can be read.
class BroadphaseDock : public Panel {
    Q_OBJECT
  public:
    explicit BroadphaseDock(QWidget* parent = nullptr);

    void showPipeline(std::shared_ptr<const Pipeline> pipeline);
    void addSamples(std::span<const FrameSample> samples);
    void clear();
    /// Null: as the scene asks.
    const BroadphaseRow* chosen() const;

  Q_SIGNALS:
    void algorithmChosen(const carom::BroadphaseRow* row);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    void refresh();
    void setColumns(int columns);
    void fitColumns();

    QComboBox* m_algorithm;
    QLabel* m_reason;
    QGridLayout* m_grid;
    int m_columns = 0; ///< of figures
    BroadphaseComparison* m_comparison;
    std::vector<QLabel*> m_titles, m_values; ///< one a row of the table in the source file
    FrameStatistics m_newest;
    QElapsedTimer m_sinceRefresh;
};

} // namespace carom
