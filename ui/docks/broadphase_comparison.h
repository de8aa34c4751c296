// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/benchmark.h"

#include <QWidget>

#include <memory>
#include <thread>

class QLabel;
class QPushButton;

namespace carom {

class ValueTable;

/// "Compare all": every broad-phase on the scene from its start, over the same frames, and what each took. It
/// works on a thread and on worlds of its own; the running simulation goes on.
class BroadphaseComparison : public QWidget {
    Q_OBJECT
  public:
    explicit BroadphaseComparison(QWidget* parent = nullptr);

    /// The scene to compare on next; figures of another scene are taken away. May be null.
    void setPipeline(std::shared_ptr<const Pipeline> pipeline);

  private:
    void startOrStop();
    void run(const std::stop_token& stop, const std::shared_ptr<const Pipeline>& pipeline);
    void finish(const std::vector<BenchmarkPoint>& points, const Pipeline* compared);
    void showFigures(const std::vector<BenchmarkPoint>& points);

    std::shared_ptr<const Pipeline> m_pipeline;
    QPushButton* m_button;
    QLabel* m_state;
    ValueTable* m_table;
    bool m_running = false;
    std::jthread m_thread; ///< last: it ends before what it speaks to
};

} // namespace carom
