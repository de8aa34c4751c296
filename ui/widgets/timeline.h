// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/bounded_series.h"
#include "core/simulation/statistics.h"
#include "ui/widgets/scrub_strip.h"
#include "ui/base/theme.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace carom {

/// The run as a line one can move along: where it is, how far it has been, and marks where something
/// happened. Dragging seeks, also to where the run has not been yet; whether it plays is not its concern.
///
///     impacts            ▂   ▅▂    ▃
///     ────────────────────────●───────────────────┄┄┄┄┄┄┄┄┄┄┄
///     0 s            ▲        now       furthest         end of the scale
///                    warning, stop
class Timeline : public ScrubStrip {
    Q_OBJECT

  public:
    explicit Timeline(QWidget* parent = nullptr);

    /// A new run: `step` [s] a frame, `duration` [s] where the scene has one. The position stays.
    void restart(double step, std::optional<double> duration);
    /// In the order they were simulated; those that came before are passed over. Memory does not grow with a
    /// run: of a long one each stretch of frames has its greatest number of impacts.
    void addFrames(const std::vector<FrameStatistics>& frames);
    void showFrame(std::int64_t frame);
    void markWarning(std::int64_t frame);
    /// Frames at which a breakpoint held.
    void markHit(std::int64_t frame);
    /// Frames at which an expectation first failed, in place of those before.
    void setFailures(std::vector<std::int64_t> frames);
    void setTheme(const Theme& theme);

    std::int64_t frame() const { return m_frame; }
    std::int64_t furthest() const { return m_impacts.count(); }
    /// The frame at the right end.
    std::int64_t end() const;
    /// Contacts that were not there in the frame before; in a long run the most of the frames around it.
    std::uint64_t impactsIn(std::int64_t frame) const;
    const std::vector<std::int64_t>& warnings() const { return m_warnings; }
    const std::vector<std::int64_t>& hits() const { return m_hits; }
    const std::vector<std::int64_t>& failures() const { return m_failures; }
    std::size_t bytes() const { return m_impacts.bytes(); }
    double xOf(std::int64_t frame) const; ///< [px]
    std::int64_t frameAt(double x) const;

    QSize sizeHint() const override { return {600, 38}; }
    QSize minimumSizeHint() const override { return {160, 38}; }

  Q_SIGNALS:
    void seeked(std::int64_t frame);
    /// A bar or a mark was clicked, off the line.
    void eventClicked(std::int64_t frame);
    /// The mark of an expectation that failed was clicked.
    void failureClicked(std::int64_t frame);

  protected:
    void mousePressEvent(QMouseEvent* event) override;
    void goTo(double x) override { seekTo(frameAt(x)); }
    QString tellOf(double x) const override;
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    void seekTo(std::int64_t frame);
    std::optional<std::int64_t> eventAt(const QPointF& position) const;
    void paintImpacts(QPainter& painter) const;
    void paintMarks(QPainter& painter, const std::vector<std::int64_t>& frames, const QColor& colour) const;
    void paintFailures(QPainter& painter) const;

    Theme m_theme;
    double m_step = 1.0 / 60; ///< [s]
    std::optional<double> m_duration;
    std::int64_t m_frame = 0;
    std::uint64_t m_touching = 0; ///< contacts of the last frame added
    BoundedSeries m_impacts;      ///< of frame 1 at place 0
    std::vector<std::int64_t> m_warnings, m_hits, m_failures;
};

} // namespace carom
