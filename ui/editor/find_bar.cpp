// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/find_bar.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStyle>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

QLineEdit* field(const QString& placeholder, QWidget* parent) {
    QLineEdit* edit = new QLineEdit(parent);
    edit->setPlaceholderText(placeholder);
    edit->setAccessibleName(placeholder);
    edit->setClearButtonEnabled(true);
    return edit;
}

} // namespace

FindBar::FindBar(SceneEditor& editor, QWidget* parent)
    : QWidget(parent), m_editor(editor), m_find(field(tr("Find"), this)),
      m_replace(field(tr("Replace by"), this)),
      m_regularExpression(new QCheckBox(tr("Regular e&xpression"), this)),
      m_matchCase(new QCheckBox(tr("Match &case"), this)), m_message(new QLabel(this)) {
    QPushButton* previous = new QPushButton(tr("&Previous"), this);
    QPushButton* next = new QPushButton(tr("&Next"), this);
    QPushButton* replace = new QPushButton(tr("&Replace"), this);
    QPushButton* replaceEvery = new QPushButton(tr("Replace &all"), this);

    QGridLayout* grid = new QGridLayout(this);
    grid->setContentsMargins(8, 6, 8, 6);
    grid->setSpacing(6);
    grid->addWidget(m_find, 0, 0);
    grid->addWidget(previous, 0, 1);
    grid->addWidget(next, 0, 2);
    grid->addWidget(m_replace, 1, 0);
    grid->addWidget(replace, 1, 1);
    grid->addWidget(replaceEvery, 1, 2);
    QHBoxLayout* options = new QHBoxLayout;
    options->addWidget(m_regularExpression);
    options->addWidget(m_matchCase);
    options->addStretch();
    options->addWidget(m_message);
    grid->addLayout(options, 2, 0, 1, 3);
    grid->setColumnStretch(0, 1);

    connect(m_find, &QLineEdit::textEdited, this, &FindBar::searchWhileTyping);
    connect(m_regularExpression, &QCheckBox::toggled, this, &FindBar::searchWhileTyping);
    connect(m_matchCase, &QCheckBox::toggled, this, &FindBar::searchWhileTyping);
    connect(next, &QPushButton::clicked, this, &FindBar::findNext);
    connect(previous, &QPushButton::clicked, this, &FindBar::findPrevious);
    connect(replace, &QPushButton::clicked, this, &FindBar::replaceOne);
    connect(replaceEvery, &QPushButton::clicked, this, &FindBar::replaceAll);
    setObjectName(QStringLiteral("findBar"));
    m_find->setObjectName(QStringLiteral("find"));
    m_replace->setObjectName(QStringLiteral("replace"));
    hide();
}

void FindBar::activate() {
    m_origin = m_editor.send(Sci::SCI_GETSELECTIONSTART);
    const QString selected = m_editor.selectedText();
    const bool oneLine = !selected.contains(u'\n') && !selected.contains(u'\r');
    if (!selected.isEmpty() && oneLine) m_find->setText(selected);
    show();
    m_find->setFocus();
    m_find->selectAll();
    say({});
}

void FindBar::findNext() { search(m_editor.send(Sci::SCI_GETSELECTIONEND), true); }

void FindBar::findPrevious() { search(m_editor.send(Sci::SCI_GETSELECTIONSTART), false); }

/// Esc means this bar while the keyboard is in it, not the window's way back to the text.
bool FindBar::event(QEvent* event) {
    const bool escape =
        event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape;
    if (!escape) return QWidget::event(event);
    event->accept();
    return true;
}

void FindBar::keyPressEvent(QKeyEvent* event) {
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (event->key() == Qt::Key_Escape)
        close();
    else if (enter && focusWidget() == m_replace)
        replaceOne();
    else if (enter && event->modifiers().testFlag(Qt::ShiftModifier))
        findPrevious();
    else if (enter)
        findNext();
    else
        QWidget::keyPressEvent(event);
}

SearchQuery FindBar::query() const {
    return {m_find->text(), m_regularExpression->isChecked(), m_matchCase->isChecked()};
}

void FindBar::search(std::int64_t from, bool forward) {
    if (query().text.isEmpty()) {
        activate();
        return;
    }
    const std::int64_t length = m_editor.send(Sci::SCI_GETLENGTH);
    std::optional<SourceRange> match = findMatch(m_editor, query(), from, forward ? length : 0);
    const bool wrapped = !match;
    if (wrapped) match = findMatch(m_editor, query(), forward ? 0 : length, forward ? length : 0);
    if (!match) {
        say(tr("not found"), true);
        return;
    }
    m_editor.reveal(*match);
    const int matches = countMatches(m_editor, query());
    const QString count = matches == 1 ? tr("1 match") : tr("%1 matches").arg(matches);
    say(!wrapped  ? count
        : forward ? tr("%1; went on from the top").arg(count)
                  : tr("%1; went on from the end").arg(count));
}

void FindBar::searchWhileTyping() {
    if (m_find->text().isEmpty())
        say({});
    else
        search(m_origin, true);
}

void FindBar::replaceOne() {
    const std::int64_t begin = m_editor.send(Sci::SCI_GETSELECTIONSTART);
    const std::int64_t end = m_editor.send(Sci::SCI_GETSELECTIONEND);
    const std::optional<SourceRange> match = findMatch(m_editor, query(), begin, end);
    const bool selected = match && match->offset == begin && match->end() == end;
    if (!selected) {
        findNext();
        return;
    }
    search(replaceMatch(m_editor, query(), *match, m_replace->text()), true);
}

void FindBar::replaceAll() {
    const int count = replaceAllMatches(m_editor, query(), m_replace->text());
    say(tr("%n replaced", nullptr, count), count == 0);
}

void FindBar::close() {
    hide();
    m_editor.setFocus();
}

void FindBar::say(const QString& message, bool isProblem) {
    m_message->setText(message);
    m_message->setProperty("role", isProblem ? QStringLiteral("error") : QStringLiteral("muted"));
    m_message->style()->polish(m_message);
}

} // namespace carom
