// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/rectangle_drag.h"

#include <QMouseEvent>

#include <algorithm>

namespace carom {

using Sci = QsciScintillaBase;

RectangleDrag::RectangleDrag(SceneEditor& editor) : QObject(&editor), m_editor(editor) {
    editor.viewport()->installEventFilter(this);
}

void RectangleDrag::takeCorner(const QMouseEvent& event, bool begins) {
    const QPoint place = event.position().toPoint();
    const long at = m_editor.send(Sci::SCI_POSITIONFROMPOINT, place.x(), place.y());
    const long end = m_editor.send(Sci::SCI_GETLINEENDPOSITION, m_editor.send(Sci::SCI_LINEFROMPOSITION, at));
    const long behindEnd = place.x() - m_editor.send(Sci::SCI_POINTXFROMPOSITION, 0, end);
    const long column = std::max(1L, m_editor.SendScintilla(Sci::SCI_TEXTWIDTH, Sci::STYLE_DEFAULT, " "));
    const long blanks = at == end ? std::max(0L, behindEnd / column) : 0;
    if (begins) {
        m_editor.send(Sci::SCI_SETRECTANGULARSELECTIONANCHOR, at);
        m_editor.send(Sci::SCI_SETRECTANGULARSELECTIONANCHORVIRTUALSPACE, blanks);
    }
    m_editor.send(Sci::SCI_SETRECTANGULARSELECTIONCARET, at);
    m_editor.send(Sci::SCI_SETRECTANGULARSELECTIONCARETVIRTUALSPACE, blanks);
    if (!begins) m_editor.send(Sci::SCI_SCROLLCARET);
}

/// Scintilla's own way with Ctrl moves the one caret there is. A second click takes the caret away.
void RectangleDrag::addCaret(const QPoint& place) {
    const long at = m_editor.send(Sci::SCI_POSITIONFROMPOINT, place.x(), place.y());
    const long count = m_editor.send(Sci::SCI_GETSELECTIONS);
    m_editor.setFocus();
    for (long i = 0; i < count; ++i) {
        const bool here = m_editor.send(Sci::SCI_GETSELECTIONNCARET, i) == at &&
                          m_editor.send(Sci::SCI_GETSELECTIONNANCHOR, i) == at;
        if (!here) continue;
        if (count > 1) m_editor.send(Sci::SCI_DROPSELECTIONN, i);
        return;
    }
    m_editor.send(Sci::SCI_ADDSELECTION, at, at);
}

bool RectangleDrag::eventFilter(QObject* watched, QEvent* event) {
    const bool press = event->type() == QEvent::MouseButtonPress;
    const bool release = event->type() == QEvent::MouseButtonRelease;
    if (!press && !release && event->type() != QEvent::MouseMove) return QObject::eventFilter(watched, event);
    const QMouseEvent& mouse = static_cast<QMouseEvent&>(*event);
    const bool adds = mouse.button() == Qt::LeftButton && mouse.modifiers() == Qt::ControlModifier;
    if (adds && press) addCaret(mouse.position().toPoint());
    if (adds) return true;
    if (press) {
        m_dragging = mouse.button() == Qt::LeftButton && mouse.modifiers() == Qt::AltModifier;
        if (m_dragging) m_editor.setFocus();
    }
    if (!m_dragging) return QObject::eventFilter(watched, event);
    takeCorner(mouse, press);
    m_dragging = !release;
    return true;
}

} // namespace carom

#include "moc_rectangle_drag.cpp"
