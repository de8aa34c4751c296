// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/broadphase_comparison.h"

#include "ui/widgets/value_table.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace carom {
namespace {

constexpr std::int64_t comparedFrames = 120;

QStringList algorithmTitles() {
    QStringList titles;
    for (const BroadphaseRow& row : broadphases())
        titles << QString::fromUtf8(row.title.data(), static_cast<qsizetype>(row.title.size()));
    return titles;
}

} // namespace

BroadphaseComparison::BroadphaseComparison(QWidget* parent)
    : QWidget(parent), m_button(new QPushButton(tr("Compare all"))), m_state(new QLabel),
      m_table(new ValueTable(algorithmTitles(), {tr("Broad-phase [ms]"), tr("Frame [ms]"), tr("First [ms]"),
                                                 tr("Tested"), tr("Overlapping")})) {
    m_button->setObjectName(QStringLiteral("compare"));
    m_button->setToolTip(tr("Run the first %1 frames of the scene with every algorithm").arg(comparedFrames));
    m_state->setObjectName(QStringLiteral("comparisonState"));
    m_state->setProperty("role", QStringLiteral("muted"));
    m_table->setObjectName(QStringLiteral("comparison"));
    m_table->setAccessibleName(tr("What each algorithm took"));
    m_table->hide();

    QHBoxLayout* top = new QHBoxLayout;
    top->addWidget(m_button);
    top->addWidget(m_state, 1);
    QVBoxLayout* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addLayout(top);
    column->addWidget(m_table);
    connect(m_button, &QPushButton::clicked, this, &BroadphaseComparison::startOrStop);
    setPipeline(nullptr);
}

void BroadphaseComparison::setPipeline(std::shared_ptr<const Pipeline> pipeline) {
    m_pipeline = std::move(pipeline);
    m_button->setEnabled(m_running || m_pipeline);
    if (m_running) return;
    m_table->hide();
    m_state->clear();
}

void BroadphaseComparison::startOrStop() {
    if (m_running) {
        m_thread.request_stop();
        return;
    }
    m_running = true;
    m_button->setText(tr("Stop"));
    m_table->hide();
    m_thread =
        std::jthread([this, pipeline = m_pipeline](const std::stop_token& stop) { run(stop, pipeline); });
}

// On the thread: whatever touches a widget is handed to the GUI's.
void BroadphaseComparison::run(const std::stop_token& stop, const std::shared_ptr<const Pipeline>& pipeline) {
    std::int64_t shown = -1;
    const BenchmarkListener listener = [&](std::int64_t done, std::int64_t total) {
        const std::int64_t percent = 100 * done / total;
        if (percent != shown)
            QMetaObject::invokeMethod(
                this, [this, percent] { m_state->setText(tr("%1 %").arg(percent)); }, Qt::QueuedConnection);
        shown = percent;
        return !stop.stop_requested();
    };
    const std::vector<BenchmarkPoint> points = compareBroadphases(pipeline, comparedFrames, listener);
    QMetaObject::invokeMethod(
        this, [this, points, pipeline] { finish(points, pipeline.get()); }, Qt::QueuedConnection);
}

void BroadphaseComparison::finish(const std::vector<BenchmarkPoint>& points, const Pipeline* compared) {
    m_thread.join();
    m_running = false;
    m_button->setText(tr("Compare all"));
    m_button->setEnabled(m_pipeline != nullptr);
    m_state->clear();
    if (points.empty()) return m_state->setText(tr("Stopped."));
    if (compared != m_pipeline.get()) return m_state->setText(tr("The scene has changed meanwhile."));
    showFigures(points);
}

void BroadphaseComparison::showFigures(const std::vector<BenchmarkPoint>& points) {
    for (std::size_t k = 0; k < points.size(); ++k) {
        const int row = static_cast<int>(k);
        const BenchmarkPoint& point = points[k];
        m_table->setValue(row, 0, point.broadphase);
        m_table->setValue(row, 1, point.simulate.median);
        m_table->setValue(row, 2, point.first);
        m_table->setValue(row, 3, point.tested, 1);
        m_table->setValue(row, 4, point.pairs, 1);
    }
    const std::vector<BenchmarkPoint>::const_iterator best =
        std::min_element(points.begin(), points.end(), [](const BenchmarkPoint& a, const BenchmarkPoint& b) {
            return a.broadphase < b.broadphase;
        });
    const QString title = algorithmTitles()[static_cast<qsizetype>(best - points.begin())];
    m_state->setText(
        tr("%1 frames of the scene from its start: %2 was fastest.").arg(comparedFrames).arg(title));
    m_table->show();
}

} // namespace carom
