// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/find_bar.h"

#include "ui/base/failures.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStyle>

#include <algorithm>
#include <utility>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

constexpr int matchIndicator = 14; // below it are those of snippets and diagnostics
constexpr int markOpacity = 70;    // [0..255]

QLineEdit* field(const QString& placeholder, QWidget* parent) {
    QLineEdit* edit = new QLineEdit(parent);
    edit->setPlaceholderText(placeholder);
    edit->setAccessibleName(placeholder);
    edit->setClearButtonEnabled(true);
    return edit;
}

} // namespace

int replaceAllMatches(SceneEditor& editor, const SearchQuery& query, const QString& replacement) {
    const TextSearch search(query);
    const QByteArray text = editor.bytes();
    const std::vector<SourceRange> matches = search.all(text, [] { return true; });
    editor.send(Sci::SCI_BEGINUNDOACTION);
    // From the end, so that places stay where they are.
    for (auto match = matches.rbegin(); match != matches.rend(); ++match)
        editor.replaceRange(*match, editor.withLineEnds(search.replacementOf(text, *match, replacement)));
    editor.send(Sci::SCI_ENDUNDOACTION);
    return static_cast<int>(matches.size());
}

FindBar::FindBar(SceneEditor& editor, QWidget* parent)
    : QWidget(parent), m_editor(editor), m_find(field(tr("Find"), this)),
      m_replace(field(tr("Replace with"), this)),
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

    connect(&editor, &SceneEditor::textChanged, this, &FindBar::forgetMatches);
    m_counter.setMaxThreadCount(1);
    editor.send(Sci::SCI_INDICSETSTYLE, matchIndicator, Sci::INDIC_ROUNDBOX);
    editor.send(Sci::SCI_INDICSETUNDER, matchIndicator, 1);
    const QColor mark = palette().color(QPalette::Highlight);
    editor.send(Sci::SCI_INDICSETFORE, matchIndicator, mark.red() | mark.green() << 8 | mark.blue() << 16);
    editor.send(Sci::SCI_INDICSETALPHA, matchIndicator, markOpacity);
}

FindBar::~FindBar() {
    if (m_counting) *m_counting = false;
    m_counter.waitForDone();
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
    const TextSearch search(query());
    if (!search.problem().isEmpty()) {
        forgetMatches();
        say(tr("no regular expression: %1").arg(search.problem()), true);
        return;
    }
    const QByteArray text = m_editor.bytes();
    const auto look = [&](std::int64_t place) {
        return forward ? search.next(text, place) : search.previous(text, place);
    };
    std::optional<SourceRange> match = look(from);
    // An empty match where one is already: the next one.
    const SourceRange here = selection();
    if (match && match->length == 0 && match->offset == here.offset && here.length == 0)
        match = forward ? look(from + 1) : from > 0 ? look(from - 1) : std::nullopt;
    const bool wrapped = !match;
    if (wrapped) match = look(forward ? 0 : text.size());
    if (!match) {
        forgetMatches();
        say(tr("not found"), true);
        return;
    }
    m_wrapped = !wrapped ? QString() : forward ? tr("; went on from the top") : tr("; went on from the end");
    m_editor.reveal(*match);
    if (m_matches.empty() || !(m_counted == query()))
        count(text);
    else
        sayWhich();
}

void FindBar::count(const QByteArray& text) {
    constexpr qsizetype countedAtOnce = 256 * 1024; // [bytes]
    forgetMatches();
    m_counted = query();
    if (text.size() <= countedAtOnce) {
        take(TextSearch(m_counted).all(text, [] { return true; }));
        return;
    }
    say(tr("counting…"));
    m_counting = std::make_shared<std::atomic<bool>>(true);
    m_counter.start([this, text, wanted = query(), goOn = m_counting] {
        std::vector<SourceRange> found;
        const QString problem =
            attempt([&] { found = TextSearch(wanted).all(text, [&goOn] { return goOn->load(); }); });
        QMetaObject::invokeMethod(
            this,
            [this, goOn, problem, found] {
                if (goOn != m_counting) return; // of another text or query
                if (problem.isEmpty())
                    take(found);
                else
                    say(problem, true);
            },
            Qt::QueuedConnection);
    });
}

void FindBar::take(std::vector<SourceRange> matches) {
    m_counting.reset();
    m_matches = std::move(matches);
    m_editor.send(Sci::SCI_SETINDICATORCURRENT, matchIndicator);
    for (const SourceRange match : m_matches)
        if (match.length > 0) m_editor.send(Sci::SCI_INDICATORFILLRANGE, match.offset, match.length);
    sayWhich();
}

void FindBar::forgetMatches() {
    if (m_counting) *m_counting = false;
    m_counting.reset();
    if (m_matches.empty()) return;
    m_matches.clear();
    m_editor.send(Sci::SCI_SETINDICATORCURRENT, matchIndicator);
    m_editor.send(Sci::SCI_INDICATORCLEARRANGE, 0, m_editor.send(Sci::SCI_GETLENGTH));
}

/// "2 of 5", where the selection is one of them.
void FindBar::sayWhich() {
    const SourceRange here = selection();
    const auto found = std::lower_bound(m_matches.begin(), m_matches.end(), here,
                                        [](SourceRange a, SourceRange b) { return a.offset < b.offset; });
    const bool isOne =
        found != m_matches.end() && found->offset == here.offset && found->length == here.length;
    const QString all = m_matches.size() < TextSearch::mostMatches
                            ? QString::number(m_matches.size())
                            : tr("more than %1").arg(m_matches.size() - 1);
    const QString which = isOne ? tr("%1 of %2").arg(QString::number(found - m_matches.begin() + 1), all)
                                : tr("%1 found").arg(all);
    say(which + m_wrapped);
}

SourceRange FindBar::selection() const {
    const long begin = m_editor.send(Sci::SCI_GETSELECTIONSTART),
               end = m_editor.send(Sci::SCI_GETSELECTIONEND);
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)};
}

void FindBar::searchWhileTyping() {
    if (m_find->text().isEmpty()) {
        forgetMatches();
        say({});
    } else {
        search(m_origin, true);
    }
}

void FindBar::replaceOne() {
    const TextSearch search(query());
    const QByteArray text = m_editor.bytes();
    const SourceRange here = selection();
    if (!search.isMatch(text, here)) {
        findNext();
        return;
    }
    const QByteArray written = m_editor.withLineEnds(search.replacementOf(text, here, m_replace->text()));
    m_editor.replaceRange(here, written);
    this->search(here.offset + written.size(), true);
}

void FindBar::replaceAll() {
    const int count = replaceAllMatches(m_editor, query(), m_replace->text());
    say(tr("%n replaced", nullptr, count), count == 0);
}

void FindBar::close() {
    hide();
    forgetMatches();
    m_editor.setFocus();
}

void FindBar::say(const QString& message, bool isProblem) {
    m_message->setText(message);
    m_message->setProperty("role", isProblem ? QStringLiteral("error") : QStringLiteral("muted"));
    m_message->style()->polish(m_message);
}

} // namespace carom

#include "moc_find_bar.cpp"
