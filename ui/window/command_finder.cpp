// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/command_finder.h"

#include <QAction>
#include <QApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace carom {
namespace {

constexpr QSize boxSize{620, 380}; // [px]
constexpr int fromTop = 60;        // [px] of the window

QString plainText(const QAction& action) { return action.text().remove(u'&').remove(u'…'); }

} // namespace

int fitOf(const QString& text, const QString& words) {
    constexpr int inside = 100; // a match inside a word is worse than any at a beginning
    int fit = 0;
    for (const QString& word : words.split(u' ', Qt::SkipEmptyParts)) {
        int best = -1;
        for (qsizetype at = text.indexOf(word, 0, Qt::CaseInsensitive); at >= 0;
             at = text.indexOf(word, at + 1, Qt::CaseInsensitive)) {
            const bool begins = at == 0 || !text[at - 1].isLetterOrNumber();
            const int here = static_cast<int>(at) + (begins ? 0 : inside);
            if (best < 0 || here < best) best = here;
        }
        if (best < 0) return -1;
        fit += best;
    }
    return fit;
}

CommandFinder::CommandFinder(QMainWindow& window)
    : QFrame(&window), m_window(window), m_words(new QLineEdit), m_list(new QTreeWidget), m_tip(new QLabel) {
    setObjectName(QStringLiteral("commandFinder"));
    setProperty("role", QStringLiteral("popup"));
    setAutoFillBackground(true);
    QVBoxLayout* column = new QVBoxLayout(this);
    column->setContentsMargins(10, 10, 10, 8);
    column->setSpacing(8);
    column->addWidget(m_words);
    column->addWidget(m_list, 1);
    column->addWidget(m_tip);
    m_words->setPlaceholderText(tr("What do you want to do?"));
    m_words->setAccessibleName(tr("Command"));
    m_words->installEventFilter(this);
    m_list->setAccessibleName(tr("Commands"));
    m_list->setColumnCount(2);
    m_list->setHeaderHidden(true);
    m_list->setRootIsDecorated(false);
    m_list->setUniformRowHeights(true);
    m_list->setFocusPolicy(Qt::NoFocus);
    m_list->header()->setStretchLastSection(false);
    m_list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_list->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    m_tip->setProperty("role", QStringLiteral("muted"));
    connect(m_words, &QLineEdit::textChanged, this, &CommandFinder::narrow);
    connect(m_words, &QLineEdit::returnPressed, this, &CommandFinder::run);
    connect(m_list, &QTreeWidget::itemClicked, this, &CommandFinder::run);
    connect(m_list, &QTreeWidget::currentItemChanged, this, &CommandFinder::explain);
    hide();
}

void CommandFinder::activate() {
    if (!isVisible()) m_before = QApplication::focusWidget();
    collect();
    const QSize size = boxSize.boundedTo(m_window.size() - QSize(40, fromTop + 20));
    setGeometry((m_window.width() - size.width()) / 2, fromTop, size.width(), size.height());
    m_words->clear();
    narrow();
    show();
    raise();
    m_words->setFocus();
}

void CommandFinder::collect() {
    m_commands.clear();
    std::vector<std::pair<const QMenu*, QString>> open;
    for (const QAction* top : m_window.menuBar()->actions())
        if (top->menu() != nullptr) open.emplace_back(top->menu(), plainText(*top));
    while (!open.empty()) {
        const auto [menu, path] = open.back();
        open.pop_back();
        for (QAction* action : menu->actions()) {
            if (action->isSeparator()) continue;
            const QString name = path + QStringLiteral(" › ") + plainText(*action);
            if (action->menu() != nullptr)
                open.emplace_back(action->menu(), name);
            else
                m_commands.push_back({action, name});
        }
    }
    std::sort(m_commands.begin(), m_commands.end(),
              [](const Command& a, const Command& b) { return a.path.localeAwareCompare(b.path) < 0; });
}

void CommandFinder::narrow() {
    std::vector<std::pair<int, std::size_t>> found;
    for (std::size_t i = 0; i < m_commands.size(); ++i) {
        const QString text = plainText(*m_commands[i].action) + u' ' + m_commands[i].path;
        // What the name does not say the status tip may; a name that fits comes first.
        constexpr int onlyInTip = 10000;
        const int fit = fitOf(text, m_words->text());
        const int withTip =
            fit >= 0 ? fit : fitOf(text + u' ' + m_commands[i].action->statusTip(), m_words->text());
        if (withTip >= 0) found.emplace_back(fit >= 0 ? fit : onlyInTip + withTip, i);
    }
    if (!m_words->text().isEmpty()) std::stable_sort(found.begin(), found.end());
    m_list->clear();
    for (const auto& [fit, i] : found) {
        const QAction& action = *m_commands[i].action;
        QTreeWidgetItem* item =
            new QTreeWidgetItem({m_commands[i].path, action.shortcut().toString(QKeySequence::NativeText)});
        item->setData(0, Qt::UserRole, static_cast<qulonglong>(i));
        item->setIcon(0, action.icon());
        item->setDisabled(!action.isEnabled());
        if (action.isCheckable())
            item->setText(0, item->text(0) + (action.isChecked() ? tr(" (on)") : QString()));
        m_list->addTopLevelItem(item);
    }
    m_list->setCurrentItem(m_list->topLevelItem(0));
    explain();
}

void CommandFinder::explain() {
    const QTreeWidgetItem* item = m_list->currentItem();
    m_tip->setText(item == nullptr
                       ? tr("Nothing is called that.")
                       : m_commands[item->data(0, Qt::UserRole).toULongLong()].action->statusTip());
}

void CommandFinder::run() {
    const QTreeWidgetItem* item = m_list->currentItem();
    if (item == nullptr || item->isDisabled()) return;
    QAction* action = m_commands[item->data(0, Qt::UserRole).toULongLong()].action;
    close();
    action->trigger();
}

void CommandFinder::close() {
    hide();
    if (m_before != nullptr) m_before->setFocus();
}

bool CommandFinder::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::FocusOut && isVisible() && !isAncestorOf(QApplication::focusWidget())) {
        hide();
        return false;
    }
    const bool key = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
    if (!key) return QFrame::eventFilter(watched, event);
    const int pressed = static_cast<QKeyEvent*>(event)->key();
    if (pressed == Qt::Key_Escape) {
        if (event->type() == QEvent::KeyPress)
            close();
        else
            event->accept();
        return true;
    }
    const bool moves = pressed == Qt::Key_Up || pressed == Qt::Key_Down || pressed == Qt::Key_PageUp ||
                       pressed == Qt::Key_PageDown;
    if (!moves || event->type() != QEvent::KeyPress) return false;
    QApplication::sendEvent(m_list, event);
    return true;
}

} // namespace carom

#include "moc_command_finder.cpp"
