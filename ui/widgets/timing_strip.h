// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/widgets/frame_parts.h"
#include "ui/widgets/scrub_strip.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace carom {

/// Parts of a frame that are left out of a graph.
using HiddenParts = std::array<bool, framePartCount>;

/// Rows of pixels that each part of a frame takes in a graph `height` pixels high that shows 0 to
/// `fullScale` ms. Every boundary is rounded once, so the parts of a frame add up to the height of its total.
std::array<int, framePartCount> stackedRows(const FrameSample& sample, double fullScale, int height,
                                            const HiddenParts& hidden = {});

/// The live graph of frame times: one column a frame, its parts stacked, the newest at the right; zoomed out,
/// a column is of several frames and shows the slowest of them. The wheel zooms at the mouse, + and - at the
/// right edge; a drag with the right or middle button moves along the run, as do Shift with the wheel, Page
/// Up, Page Down, Home and End. The columns are written straight into an image, which costs a tenth of a
/// plotting library's repaint.
class TimingStrip : public ScrubStrip {
    Q_OBJECT

  public:
    /// Budget shows the lines of 1/60 and 1/30 s always; Fit fills the height with what there is.
    enum class Scale { Budget, Fit };

    /// Half an hour at 60 frames a second, 70 MB with their ledgers.
    static constexpr std::size_t mostSamples = 108'000;
    /// What no frame is.
    static constexpr std::ptrdiff_t noFrame = -1;

    explicit TimingStrip(QWidget* parent = nullptr);

    void addSamples(std::span<const FrameSample> samples);
    void clear();
    /// Of the samples [bytes]; the oldest half goes when there are more.
    void setBudget(std::size_t bytes);
    std::size_t bytes() const { return m_samples.capacity() * sizeof(FrameSample); }
    /// The frame on screen: a line, where it is among the samples.
    void showFrame(std::int64_t frame);
    /// Of the frame on screen [px], or nothing where it is not in the graph.
    std::optional<int> cursor() const;
    void setScale(Scale scale);
    void setColumnWidth(int pixels); ///< of one frame, 1 to 16
    int columnWidth() const { return m_columnWidth; }
    /// Frames of a column: 1, or a power of two where columns are one pixel wide.
    std::ptrdiff_t framesAColumn() const { return m_perColumn; }
    /// By one step, twice or half as many frames; what is under x stays there [px].
    void zoom(bool in, int x);
    void zoom(bool in) { zoom(in, width() - 1); }
    /// Frames between the newest and the right edge.
    std::ptrdiff_t scrolledBack() const { return m_scrolledBack; }
    /// As far as there are older frames to fill the width.
    void scrollTo(std::ptrdiff_t back);
    /// Whether a part of the frame is in the graph.
    void showPart(std::size_t part, bool shown);

    const std::vector<FrameSample>& samples() const { return m_samples; }
    double fullScale() const { return m_fullScale; } ///< [ms] at the upper edge
    /// Index into samples() of the frame that was picked, or noFrame.
    std::ptrdiff_t picked() const { return m_picked; }
    void pick(std::ptrdiff_t index);
    /// Index of the frame shown in a column of pixels, or noFrame.
    std::ptrdiff_t frameAt(int x) const;

    QSize sizeHint() const override { return {600, 140}; }
    QSize minimumSizeHint() const override { return {120, 60}; }

  Q_SIGNALS:
    void framePicked(std::ptrdiff_t index);

  protected:
    void goTo(double x) override { pick(frameAt(static_cast<int>(x))); }
    QString tellOf(double x) const override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    std::ptrdiff_t count() const { return static_cast<std::ptrdiff_t>(m_samples.size()); }
    std::ptrdiff_t columns() const { return width() / m_columnWidth; }
    std::ptrdiff_t lastColumn() const { return (count() - 1 - m_scrolledBack) / m_perColumn; }
    std::ptrdiff_t slowestOf(std::ptrdiff_t column) const;
    void rescale();
    double shownOf(const FrameSample& sample) const;
    void makeRoom(std::size_t more);
    void paintColumns(QImage& image, double pixelRatio) const;
    void paintLines(QPainter& painter) const;

    std::vector<FrameSample> m_samples;
    double m_fullScale = 40;
    std::ptrdiff_t m_picked = noFrame;
    std::int64_t m_frame = -1; ///< on screen
    std::size_t m_most = mostSamples;
    std::ptrdiff_t m_scrolledBack = 0;
    int m_columnWidth = 2;          ///< [px] of the widget
    std::ptrdiff_t m_perColumn = 1; ///< frames
    /// Of a drag along the run: where it began [px], and what m_scrolledBack was.
    std::optional<std::pair<double, std::ptrdiff_t>> m_moving;
    Scale m_scale = Scale::Budget;
    HiddenParts m_hidden{};
};

/// The parts of one frame as lines of text, for tool tips and the panel.
QString breakdownOf(const FrameSample& sample);

} // namespace carom
