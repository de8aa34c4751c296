// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/statistics.h"
#include "ui/widgets/scrub_strip.h"
#include "ui/window/theme.h"

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
    /// In the order they were simulated, each once.
    void addFrames(const std::vector<FrameStatistics>& frames);
    void showFrame(std::int64_t frame);
    void markWarning(std::int64_t frame);
    /// Frames at which a breakpoint held.
    void markHit(std::int64_t frame);
    void setTheme(const Theme& theme);

    std::int64_t frame() const { return m_frame; }
    std::int64_t furthest() const { return static_cast<std::int64_t>(m_impacts.size()); }
    /// The frame at the right end.
    std::int64_t end() const;
    /// Contacts that were not there in the frame before.
    std::uint64_t impactsIn(std::int64_t frame) const;
    const std::vector<std::int64_t>& warnings() const { return m_warnings; }
    const std::vector<std::int64_t>& hits() const { return m_hits; }
    double xOf(std::int64_t frame) const; ///< [px]
    std::int64_t frameAt(double x) const;

    QSize sizeHint() const override { return {600, 38}; }
    QSize minimumSizeHint() const override { return {160, 38}; }

  Q_SIGNALS:
    void seeked(std::int64_t frame);

  protected:
    void goTo(double x) override { seekTo(frameAt(x)); }
    QString tellOf(double x) const override;
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    void seekTo(std::int64_t frame);
    void paintImpacts(QPainter& painter) const;
    void paintMarks(QPainter& painter, const std::vector<std::int64_t>& frames, const QColor& colour) const;

    Theme m_theme;
    double m_step = 1.0 / 60; ///< [s]
    std::optional<double> m_duration;
    std::int64_t m_frame = 0;
    std::uint64_t m_touching = 0;         ///< contacts of the last frame added
    std::vector<std::uint32_t> m_impacts; ///< by frame, from 1
    std::vector<std::int64_t> m_warnings, m_hits;
};

} // namespace carom
