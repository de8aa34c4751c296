// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/number_scrubber.h"

#include "ui/base/keys.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

constexpr int pixelsPerStep = 6; // [px] of a drag
constexpr int wheelPause = 600;  // [ms] without a turn end the undo step
constexpr int coarse = 10;       // [steps] for one with Shift

} // namespace

NumberScrubber::NumberScrubber(SceneEditor& editor) : QObject(&editor), m_editor(editor) {
    editor.viewport()->installEventFilter(this);
    editor.installEventFilter(this);
    m_pause.setSingleShot(true);
    m_pause.setInterval(wheelPause);
    connect(&m_pause, &QTimer::timeout, this, &NumberScrubber::letGo);
}

bool NumberScrubber::turnAtCaret(int steps) {
    letGo();
    if (!take(m_editor.caret())) return false;
    turnTo(steps);
    letGo();
    return true;
}

bool NumberScrubber::take(std::uint32_t offset) {
    const QByteArray text = m_editor.bytes();
    const std::optional<NumberAt> number = numberAt(analyse(text.toStdString()), offset);
    if (!number) return false;
    const QByteArray literal = text.mid(number->range.offset, number->range.length);
    m_grip = Grip{*number, literal, literal};
    m_editor.send(Sci::SCI_BEGINUNDOACTION);
    return true;
}

bool NumberScrubber::takeUnder(const QPoint& place) {
    const long offset = m_editor.send(Sci::SCI_POSITIONFROMPOINTCLOSE, place.x(), place.y());
    if (offset < 0 || !take(static_cast<std::uint32_t>(offset))) return false;
    m_editor.send(Sci::SCI_GOTOPOS, m_grip->number.range.offset); // its body is outlined
    return true;
}

void NumberScrubber::turnTo(std::int64_t steps) {
    const std::optional<std::string> turnedText =
        steppedWithin(m_grip->number, m_grip->original.toStdString(), steps);
    if (!turnedText) return;
    const QByteArray literal = QByteArray::fromStdString(*turnedText);
    SourceRange& range = m_grip->number.range;
    const QByteArray there = m_editor.bytesOf(range);
    if (there != m_grip->written) { // somebody else has changed the text: never write over something else
        letGo();
        return;
    }
    if (there == literal) return;
    m_editor.replaceRange(range, literal);
    m_grip->written = literal;
    range.length = static_cast<std::uint32_t>(literal.size());
    m_editor.send(Sci::SCI_SETEMPTYSELECTION, range.end());
    Q_EMIT turned();
}

void NumberScrubber::letGo() {
    m_pause.stop();
    m_dragging = false;
    if (!m_grip) return;
    m_grip.reset();
    m_editor.send(Sci::SCI_ENDUNDOACTION);
}

bool NumberScrubber::eventFilter(QObject* watched, QEvent* event) {
    if (watched == &m_editor) {
        // Whatever else happens to the text is an undo step of its own: a key, which as a shortcut comes only
        // as ShortcutOverride, or nothing to type into.
        if (event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress) {
            if (!isModifierKey(static_cast<QKeyEvent&>(*event).key())) letGo();
        } else if (event->type() == QEvent::FocusOut || event->type() == QEvent::Hide) {
            letGo();
        }
        return false;
    }
    switch (event->type()) {
    case QEvent::MouseButtonPress:
        return press(static_cast<QMouseEvent&>(*event));
    case QEvent::MouseMove:
        return move(static_cast<QMouseEvent&>(*event));
    case QEvent::MouseButtonRelease:
        if (!m_dragging) return false;
        letGo();
        return true;
    case QEvent::Wheel:
        return wheel(static_cast<QWheelEvent&>(*event));
    default:
        return false;
    }
}

bool NumberScrubber::press(const QMouseEvent& event) {
    letGo();
    const bool alone = (event.modifiers() & ~Qt::ShiftModifier) == Qt::AltModifier;
    if (!alone || event.button() != Qt::LeftButton || !takeUnder(event.position().toPoint())) return false;
    m_dragging = true;
    m_pressedAt = event.position().toPoint();
    m_editor.setFocus();
    return true;
}

bool NumberScrubber::move(const QMouseEvent& event) {
    if (!m_dragging) return false;
    const int way = event.position().toPoint().x() - m_pressedAt.x();
    turnTo(way / pixelsPerStep * (event.modifiers() & Qt::ShiftModifier ? coarse : 1));
    return true;
}

bool NumberScrubber::wheel(const QWheelEvent& event) {
    if (!(event.modifiers() & Qt::AltModifier) || m_dragging) return false;
    const QPoint place = event.position().toPoint();
    const std::uint32_t offset =
        static_cast<std::uint32_t>(m_editor.send(Sci::SCI_POSITIONFROMPOINT, place.x(), place.y()));
    const bool sameNumber = m_grip && offset >= m_grip->number.range.offset &&
                            offset <= m_grip->number.range.end() + 1 &&
                            m_editor.bytesOf(m_grip->number.range) == m_grip->written;
    if (!sameNumber) {
        letGo();
        if (!takeUnder(place)) return true; // Alt+wheel elsewhere does nothing rather than scroll
        m_wheel = 0;
        m_wheelSteps = 0;
    }
    constexpr int notch = 120;                                  // [eighths of a degree] of an ordinary wheel
    m_wheel += event.angleDelta().x() + event.angleDelta().y(); // Alt turns some wheels sideways
    const int notches = m_wheel / notch;
    m_wheel -= notches * notch;
    m_wheelSteps += notches * (event.modifiers() & Qt::ShiftModifier ? coarse : 1);
    turnTo(m_wheelSteps);
    m_pause.start();
    return true;
}

} // namespace carom

#include "moc_number_scrubber.cpp"
