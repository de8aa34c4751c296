// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/rename_box.h"

#include "ui/widgets/text_of.h"

#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QVBoxLayout>

#include <algorithm>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

constexpr int boxWidth = 320; // [px]

} // namespace

RenameBox::RenameBox(SceneEditor& editor)
    : QFrame(editor.viewport()), m_editor(editor), m_name(new QLineEdit(this)), m_refusal(new QLabel(this)) {
    setObjectName(QStringLiteral("renameBox"));
    setProperty("role", QStringLiteral("popup"));
    setAutoFillBackground(true);
    QVBoxLayout* column = new QVBoxLayout(this);
    column->setContentsMargins(6, 6, 6, 6);
    column->setSpacing(4);
    column->addWidget(m_name);
    column->addWidget(m_refusal);
    m_name->setAccessibleName(tr("New name of the label"));
    m_refusal->setWordWrap(true);
    connect(m_name, &QLineEdit::textChanged, this, &RenameBox::judge);
    connect(m_name, &QLineEdit::returnPressed, this, &RenameBox::apply);
    connect(&editor, &SceneEditor::caretMoved, this, &RenameBox::close);
    hide();
}

bool RenameBox::begin() {
    m_analysis = analyse(m_editor.bytes().toStdString());
    m_place = m_editor.caret();
    const std::optional<LabelUse> use = labelAt(m_analysis, m_place);
    if (!use) return false;
    const std::string_view old = textOf(m_analysis.text, use->label);
    m_name->setText(textOf(old));
    m_name->selectAll();
    judge();
    const int x = static_cast<int>(m_editor.send(Sci::SCI_POINTXFROMPOSITION, 0, use->label.offset));
    const int y = static_cast<int>(m_editor.send(Sci::SCI_POINTYFROMPOSITION, 0, use->label.offset));
    const int line = static_cast<int>(m_editor.send(Sci::SCI_TEXTHEIGHT, 0));
    resize(boxWidth, sizeHint().height());
    move(std::clamp(x - 12, 0, std::max(0, parentWidget()->width() - boxWidth)), y + line);
    show();
    raise();
    m_name->setFocus();
    return true;
}

Rename RenameBox::renamed() const { return renameLabel(m_analysis, m_place, m_name->text().toStdString()); }

void RenameBox::judge() {
    const Rename rename = renamed();
    const std::size_t places = rename.edits.size();
    m_refusal->setText(!rename.refusal.empty() ? QString::fromStdString(rename.refusal)
                       : places == 0           ? tr("Enter the new name; Esc gives up")
                       : places == 1           ? tr("Enter renames it")
                                               : tr("Enter renames it in %1 places").arg(places));
    resize(boxWidth, sizeHint().height());
}

void RenameBox::apply() {
    const Rename rename = renamed();
    if (!rename.refusal.empty()) return; // it stands there to be read
    hide();
    m_editor.send(Sci::SCI_BEGINUNDOACTION);
    for (const TextEdit& edit : rename.edits)
        m_editor.replaceRange(edit.range, QByteArray::fromStdString(edit.text));
    m_editor.send(Sci::SCI_ENDUNDOACTION);
    m_editor.setFocus();
}

void RenameBox::close() {
    if (!isVisible()) return;
    hide();
    m_editor.setFocus();
}

bool RenameBox::event(QEvent* event) {
    // Esc and Enter belong to the box before they are anybody's shortcut.
    if (event->type() == QEvent::ShortcutOverride &&
        static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        event->accept();
        return true;
    }
    return QFrame::event(event);
}

void RenameBox::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape) close();
    event->accept(); // nothing typed here reaches the text below
}

} // namespace carom

#include "moc_rename_box.cpp"
