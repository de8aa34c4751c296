// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/literal_handles.h"

#include "ui/editor/colour_marks.h"
#include "ui/editor/number_scrubber.h"
#include "ui/editor/scene_lexer.h"
#include "ui/widgets/colour_picker.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>
#include <QWheelEvent>

#include <algorithm>
#include <optional>

namespace carom {

namespace {

using Sci = QsciScintillaBase;

constexpr QSize numberSize{30, 12}, colourSize{16, 12}; // [px]
constexpr int gap = 6;                                  // [px] of a colour's square behind it
constexpr int leaveTime = 400; // [ms] until an unused handle disappears; at a tenth before one reaches it

} // namespace

/// Two arrows on a button: dragged to the right the number grows.
class NumberHandle : public QWidget {
  public:
    NumberHandle(SceneEditor& editor, NumberScrubber& scrubber)
        : QWidget(editor.viewport()), m_scrubber(scrubber) {
        setObjectName(QStringLiteral("numberHandle"));
        setFixedSize(numberSize);
        setCursor(Qt::SizeHorCursor);
        setToolTip(NumberScrubber::tr("Drag to the left or right: the number changes (Shift: ten times as "
                                      "much, Ctrl: a tenth)"));
        hide();
    }

    void setOffset(std::uint32_t offset) { m_offset = offset; }
    bool isHeld() const { return m_heldAt.has_value(); }

  protected:
    void mousePressEvent(QMouseEvent* event) override {
        if (m_heldAt)
            letGo(); // a second button ends the drag
        else if (event->button() == Qt::LeftButton && m_scrubber.hold(m_offset))
            m_heldAt = event->globalPosition().toPoint().x();
    }
    void mouseMoveEvent(QMouseEvent* event) override {
        if (!m_heldAt) return;
        const Qt::KeyboardModifiers keys = event->modifiers();
        m_scrubber.drag(event->globalPosition().toPoint().x() - *m_heldAt,
                        (keys.testFlag(Qt::ShiftModifier) ? 1 : 0) -
                            (keys.testFlag(Qt::ControlModifier) ? 1 : 0));
    }
    void mouseReleaseEvent(QMouseEvent*) override { letGo(); }
    void hideEvent(QHideEvent*) override { letGo(); }
    void wheelEvent(QWheelEvent* event) override { event->ignore(); }

    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(palette().color(QPalette::Base));
        painter.setBrush(palette().color(QPalette::Highlight));
        painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 5, 5);
        painter.setPen(Qt::NoPen);
        painter.setBrush(palette().color(QPalette::HighlightedText));
        const QPointF middle = QRectF(rect()).center();
        for (const double side : {-1.0, 1.0}) {
            const QPointF tip = middle + QPointF(side * 9, 0);
            painter.drawPolygon(QPolygonF({tip, tip + QPointF(-side * 5, -3), tip + QPointF(-side * 5, 3)}));
        }
    }

  private:
    void letGo() {
        if (!m_heldAt) return;
        m_heldAt.reset();
        m_scrubber.letGo();
    }

    NumberScrubber& m_scrubber;
    std::uint32_t m_offset = 0;
    std::optional<int> m_heldAt; ///< on the screen [px]
};

/// A square of the colour beside it.
class ColourSwatch : public QWidget {
  public:
    explicit ColourSwatch(SceneEditor& editor) : QWidget(editor.viewport()) {
        setObjectName(QStringLiteral("colourSwatch"));
        setFixedSize(colourSize);
        setCursor(Qt::PointingHandCursor);
        setToolTip(LiteralHandles::tr("Choose another colour"));
        hide();
    }

    void show(std::int64_t offset, const QColor& colour) {
        m_offset = offset;
        m_colour = colour;
        update();
        QWidget::show();
    }
    std::int64_t offset() const { return m_offset; }

  protected:
    void mousePressEvent(QMouseEvent*) override {} // the text below it has no part in it
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        painter.fillRect(rect(), palette().color(QPalette::Text));
        painter.fillRect(rect().adjusted(1, 1, -1, -1), m_colour);
    }

  private:
    std::int64_t m_offset = 0;
    QColor m_colour;
};

LiteralHandles::LiteralHandles(SceneEditor& editor, NumberScrubber& scrubber)
    : QObject(&editor), m_editor(editor), m_number(new NumberHandle(editor, scrubber)),
      m_colour(new ColourSwatch(editor)) {
    editor.viewport()->setMouseTracking(true);
    for (QWidget* widget :
         {editor.viewport(), static_cast<QWidget*>(m_number), static_cast<QWidget*>(m_colour)})
        widget->installEventFilter(this);
    m_leave.setSingleShot(true);
    m_leave.setInterval(leaveTime);
    connect(&m_leave, &QTimer::timeout, this, &LiteralHandles::hide);
    connect(&editor, &QsciScintillaBase::SCN_UPDATEUI, this, [this](int updated) {
        if (m_number->isHeld()) return;
        if (updated & (Sci::SC_UPDATE_V_SCROLL | Sci::SC_UPDATE_H_SCROLL | Sci::SC_UPDATE_CONTENT)) hide();
        if (updated & Sci::SC_UPDATE_SELECTION) lookAtSelection();
    });
}

void LiteralHandles::hide() {
    m_leave.stop();
    m_number->hide();
    m_colour->hide();
}

/// What the mouse is over; between it and its handle both stay for a moment.
void LiteralHandles::lookAt(const QPoint& place) {
    const long offset = m_editor.send(Sci::SCI_CHARPOSITIONFROMPOINTCLOSE, place.x(), place.y());
    if (offset >= 0 && (offerNumber(offset) | offerColour(offset)))
        m_leave.stop();
    else if ((m_number->isVisible() || m_colour->isVisible()) && !m_leave.isActive())
        m_leave.start();
}

/// A part of one number, as a double click selects it.
void LiteralHandles::lookAtSelection() {
    const long begin = m_editor.send(Sci::SCI_GETSELECTIONSTART),
               end = m_editor.send(Sci::SCI_GETSELECTIONEND);
    if (begin == end || m_editor.send(Sci::SCI_GETSELECTIONS) > 1) return;
    for (long i = begin; i < end; ++i)
        if (m_editor.send(Sci::SCI_GETSTYLEAT, i) != SceneLexer::Number) return;
    offerNumber(begin);
}

bool LiteralHandles::offerNumber(std::int64_t offset) {
    const auto isNumber = [this](std::int64_t at) {
        return m_editor.send(Sci::SCI_GETSTYLEAT, at) == SceneLexer::Number;
    };
    if (!isNumber(offset) || m_editor.isReadOnly()) return false;
    std::int64_t begin = offset, end = offset + 1;
    while (begin > 0 && isNumber(begin - 1)) --begin;
    while (isNumber(end)) ++end;
    m_number->setOffset(static_cast<std::uint32_t>(end));
    const long left = m_editor.send(Sci::SCI_POINTXFROMPOSITION, 0, begin);
    const long right = m_editor.send(Sci::SCI_POINTXFROMPOSITION, 0, end);
    place(*m_number, begin, static_cast<int>((left + right) / 2) - numberSize.width() / 2);
    m_number->show();
    return true;
}

bool LiteralHandles::offerColour(std::int64_t offset) {
    const long packed = m_editor.send(Sci::SCI_INDICATORVALUEAT, colourIndicator, offset);
    if (packed == 0 || m_editor.isReadOnly()) return false;
    const long end = m_editor.send(Sci::SCI_INDICATOREND, colourIndicator, offset);
    place(*m_colour, end - 1, static_cast<int>(m_editor.send(Sci::SCI_POINTXFROMPOSITION, 0, end)) + gap);
    m_colour->show(offset, colourOf(packed));
    return true;
}

/// Under the line, or above it where it is the last in view.
void LiteralHandles::place(QWidget& handle, std::int64_t offset, int x) const {
    const QSize room = m_editor.viewport()->size();
    const int top = static_cast<int>(m_editor.send(Sci::SCI_POINTYFROMPOSITION, 0, offset));
    const int below = top + static_cast<int>(m_editor.send(Sci::SCI_TEXTHEIGHT, 0)) - 1;
    const int y = below + handle.height() <= room.height() ? below : top - handle.height() + 1;
    handle.move(std::clamp(x, 0, std::max(0, room.width() - handle.width())), y);
}

bool LiteralHandles::pickColourAtCaret() {
    for (const std::int64_t offset : {std::int64_t{m_editor.caret()}, std::int64_t{m_editor.caret()} - 1}) {
        if (m_editor.send(Sci::SCI_INDICATORVALUEAT, colourIndicator, offset) == 0) continue;
        pick(offset);
        return true;
    }
    return false;
}

/// Written over the colour only as long as it stands there as it was.
void LiteralHandles::pick(std::int64_t offset) {
    const long packed = m_editor.send(Sci::SCI_INDICATORVALUEAT, colourIndicator, offset);
    if (packed == 0) return;
    const long begin = m_editor.send(Sci::SCI_INDICATORSTART, colourIndicator, offset);
    const long end = m_editor.send(Sci::SCI_INDICATOREND, colourIndicator, offset);
    const SourceRange range{static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)};
    const QByteArray before = m_editor.bytesOf(range);
    hide();
    pickColour(&m_editor, colourOf(packed), [this, range, before](const QString& text) {
        if (m_editor.bytesOf(range) == before) m_editor.replaceRange(range, text.toUtf8());
    });
}

bool LiteralHandles::eventFilter(QObject* watched, QEvent* event) {
    // Not asked of the editor, of which little may be left: its last events come while it is being destroyed.
    if (watched == m_number || watched == m_colour) {
        if (event->type() == QEvent::Enter) m_leave.stop();
        if (event->type() == QEvent::Leave) m_leave.start();
        if (watched == m_colour && event->type() == QEvent::MouseButtonRelease &&
            static_cast<QMouseEvent&>(*event).button() == Qt::LeftButton)
            pick(m_colour->offset());
        return false;
    }
    const bool moves = event->type() == QEvent::MouseMove;
    if (moves && static_cast<QMouseEvent&>(*event).buttons() == Qt::NoButton)
        lookAt(static_cast<QMouseEvent&>(*event).position().toPoint());
    else if (event->type() == QEvent::Leave && (m_number->isVisible() || m_colour->isVisible()))
        m_leave.start();
    return false;
}

} // namespace carom

#include "moc_literal_handles.cpp"
