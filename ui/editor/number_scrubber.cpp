// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/number_scrubber.h"

#include "ui/editor/scrub_step.h"

#include "core/language/navigation.h"
#include "core/scene/schema.h"
#include "ui/base/keys.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

/// [px] of a drag; at half single steps are hard to hit, at twice drags are long.
constexpr int pixelsPerStep = 6;
constexpr int wheelPause = 600; // [ms] without a turn end the undo step; at a tenth every notch is one

/// Of ten, by which a step is larger or smaller.
int powerOf(Qt::KeyboardModifiers keys) {
    if (!keys.testFlag(Qt::AltModifier)) return 0; // Ctrl+Shift stand for Alt there
    return (keys.testFlag(Qt::ShiftModifier) ? 1 : 0) - (keys.testFlag(Qt::ControlModifier) ? 1 : 0);
}

bool takesWholeNumbers(const Analysis& analysis, std::uint32_t offset) {
    const DeclarationSyntax* declaration = declarationAt(analysis, offset);
    const ParameterSyntax* parameter =
        declaration == nullptr ? nullptr : parameterAt(analysis, *declaration, offset);
    if (parameter == nullptr) return false;
    const DeclarationRow* row = findDeclaration(textOf(analysis.text, declaration->type));
    const ParameterRow* known = row == nullptr ? nullptr : row->find(textOf(analysis.text, parameter->name));
    return known != nullptr && known->kind == ValueKind::WholeNumber;
}

} // namespace

NumberScrubber::NumberScrubber(SceneEditor& editor) : QObject(&editor), m_editor(editor) {
    editor.viewport()->installEventFilter(this);
    editor.installEventFilter(this);
    m_pause.setSingleShot(true);
    m_pause.setInterval(wheelPause);
    connect(&m_pause, &QTimer::timeout, this, &NumberScrubber::letGo);
    connect(&editor, &SceneEditor::aboutToBeReplaced, this, &NumberScrubber::letGo);
}

bool NumberScrubber::turnAtCaret(int steps) {
    letGo();
    if (!take(m_editor.caret())) return false;
    turnTo(steps);
    letGo();
    return true;
}

bool NumberScrubber::hold(std::uint32_t offset) {
    letGo();
    if (!take(offset)) return false;
    m_editor.send(Sci::SCI_GOTOPOS, m_grip->number.range.offset); // its body is outlined
    m_editor.setFocus();
    return true;
}

void NumberScrubber::drag(int way, int power) {
    if (m_grip) turnTo(way / pixelsPerStep, power);
}

bool NumberScrubber::take(std::uint32_t offset) {
    const QByteArray text = m_editor.bytes();
    const Analysis analysis = analyse(text.toStdString());
    const std::optional<NumberAt> number = numberAt(analysis, offset);
    if (!number) return false;
    const QByteArray literal = text.mid(number->range.offset, number->range.length);
    m_grip = Grip{*number, takesWholeNumbers(analysis, number->range.end()), literal, literal};
    m_editor.send(Sci::SCI_BEGINUNDOACTION);
    return true;
}

bool NumberScrubber::takeUnder(const QPoint& place) {
    const long offset = m_editor.send(Sci::SCI_POSITIONFROMPOINTCLOSE, place.x(), place.y());
    if (offset < 0 || !take(static_cast<std::uint32_t>(offset))) return false;
    m_editor.send(Sci::SCI_GOTOPOS, m_grip->number.range.offset); // its body is outlined
    return true;
}

void NumberScrubber::turnTo(std::int64_t steps, int power) {
    const ScrubStep step = scrubStep(m_grip->original.toStdString(), m_grip->isWhole, power);
    const std::optional<std::string> turnedText =
        steps == 0 ? m_grip->original.toStdString()
                   : steppedWithin(m_grip->number, step.literal, steps * step.lastDecimals);
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
    const bool alone = (event.modifiers() & ~(Qt::ShiftModifier | Qt::ControlModifier)) == Qt::AltModifier;
    if (!alone || event.button() != Qt::LeftButton || !takeUnder(event.position().toPoint())) return false;
    m_dragging = true;
    m_pressedAt = event.position().toPoint();
    m_editor.setFocus();
    return true;
}

bool NumberScrubber::move(const QMouseEvent& event) {
    if (!m_dragging) return false;
    const int way = event.position().toPoint().x() - m_pressedAt.x();
    turnTo(way / pixelsPerStep, powerOf(event.modifiers()));
    return true;
}

bool NumberScrubber::wheel(const QWheelEvent& event) {
    // Some window managers keep Alt and the mouse to themselves.
    const bool without =
        (event.modifiers() & ~Qt::KeypadModifier) == (Qt::ControlModifier | Qt::ShiftModifier);
    if ((!(event.modifiers() & Qt::AltModifier) && !without) || m_dragging) return false;
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
        m_wheelPower = powerOf(event.modifiers());
    }
    constexpr int notch = 120;                                  // [eighths of a degree] of an ordinary wheel
    m_wheel += event.angleDelta().x() + event.angleDelta().y(); // Alt turns some wheels sideways
    const int notches = m_wheel / notch;
    m_wheel -= notches * notch;
    const int power = powerOf(event.modifiers());
    if (power != m_wheelPower) { // another step begins at what is there now
        m_grip->original = m_grip->written;
        m_wheelSteps = 0;
        m_wheelPower = power;
    }
    m_wheelSteps += notches;
    turnTo(m_wheelSteps, power);
    m_pause.start();
    return true;
}

} // namespace carom

#include "moc_number_scrubber.cpp"
