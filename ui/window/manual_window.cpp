// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/manual_window.h"

#include "core/study/hard_scenes.h"
#include "ui/widgets/resources.h"
#include "ui/widgets/text_of.h"
#include "ui/base/actions.h"

#include <QAbstractTextDocumentLayout>
#include <QAction>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QPointer>
#include <QRegularExpression>
#include <QScrollBar>
#include <QSplitter>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextTable>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace carom {
namespace {

constexpr QSize firstSize{1020, 740}; // [px]
constexpr int contentsWidth = 270;    // [px]
constexpr int margin = 24;            // [px] around the text
constexpr int pictureWidth = 660;     // [px] at most
constexpr int deepestHeading = 3;     // that the contents list
constexpr int pageRole = Qt::UserRole;
constexpr int headingRole = Qt::UserRole + 1;

/// Headings as the contents list them: from the Markdown, not the rendered page, so that all pages can be
/// listed without rendering each.
std::vector<std::pair<int, QString>> headingsOf(const QString& markdown) {
    std::vector<std::pair<int, QString>> headings;
    for (const QString& line : markdown.split(u'\n')) {
        qsizetype level = 0;
        while (level < line.size() && line[level] == u'#') ++level;
        if (level == 0 || level >= line.size() || line[level] != u' ') continue;
        headings.emplace_back(static_cast<int>(level),
                              line.mid(level + 1).remove(u'*').remove(u'`').trimmed());
    }
    return headings;
}

/// The names of the pictures on a page: ![words](images/name.png).
QStringList picturesOf(const QString& markdown) {
    static const QRegularExpression picture(QStringLiteral(R"(!\[[^\]]*\]\(([^)]+)\))"));
    QStringList names;
    for (QRegularExpressionMatchIterator found = picture.globalMatch(markdown); found.hasNext();)
        names.append(found.next().captured(1));
    return names;
}

/// Pictures that are wider than the page are made to fit it; scaled here, they stay smooth.
void addPictures(QTextDocument& document, const QString& markdown, double pixelRatio) {
    for (const QString& name : picturesOf(markdown)) {
        QImage picture(QStringLiteral(":/help/") + name);
        const int widest = static_cast<int>(pictureWidth * pixelRatio);
        if (picture.width() > widest) {
            picture = picture.scaledToWidth(widest, Qt::SmoothTransformation);
            picture.setDevicePixelRatio(pixelRatio);
        }
        document.addResource(QTextDocument::ImageResource, QUrl(name), picture);
    }
}

/// Lines that the eye finds the beginning of, and headings that belong to what follows them.
void spaceOut(QTextDocument& document) {
    constexpr double lineHeight = 130;                        // [%]
    constexpr double above = 22, aboveLesser = 16, below = 6; // [px] of a heading
    QTextCursor cursor(&document);
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        QTextBlockFormat format = block.blockFormat();
        if (format.headingLevel() > 0) {
            format.setTopMargin(format.headingLevel() <= 2 ? above : aboveLesser);
            format.setBottomMargin(below);
        } else if (!block.text().contains(QChar::ObjectReplacementCharacter)) { // a picture's line is its own
            format.setLineHeight(lineHeight, QTextBlockFormat::ProportionalHeight);
        }
        cursor.setPosition(block.position());
        cursor.setBlockFormat(format);
    }
}

/// The import begins a table's first cell with an empty line, and forgets that it is a heading.
void straightenHead(const QTextTable& table) {
    const QTextTableCell first = table.cellAt(0, 0);
    QTextCursor cursor = first.firstCursorPosition();
    if (cursor.block().text().isEmpty() && cursor.block() != first.lastCursorPosition().block())
        cursor.deleteChar();
    cursor = first.firstCursorPosition();
    cursor.setPosition(first.lastCursorPosition().position(), QTextCursor::KeepAnchor);
    QTextCharFormat bold;
    bold.setFontWeight(QFont::Bold);
    cursor.mergeCharFormat(bold);
}

/// Text and tables need more air than the import gives them.
void layOut(QTextDocument& document) {
    document.setDocumentMargin(margin);
    spaceOut(document);
    for (QTextFrame* frame : document.rootFrame()->childFrames()) {
        QTextTable* table = qobject_cast<QTextTable*>(frame);
        if (table == nullptr) continue;
        QTextTableFormat format = table->format();
        straightenHead(*table);
        format.setCellPadding(5);
        format.setWidth(QTextLength(QTextLength::PercentageLength, 99)); // the frame stands outside of it
        format.setBorder(1);
        format.setBorderCollapse(true);
        format.setBorderBrush(document.defaultTextOption().flags() ? QBrush() : QBrush(Qt::gray));
        table->setFormat(format);
    }
}

} // namespace

QString keysPage(const Actions& actions) {
    QString page = QStringLiteral("# %1\n\n").arg(ManualWindow::tr("Shortcuts"));
    page +=
        ManualWindow::tr("Every key can be changed in the preferences. Alt with 1 to 9 goes to a panel, Esc "
                         "back to the text. In the picture: the left button turns, the right one moves, the "
                         "wheel zooms, F frames the selection, Home everything, Space plays. At the start "
                         "the left button moves bodies, and the handles of a selected one move and turn it, "
                         "with Ctrl in round steps; a right click opens a menu.");
    page += QStringLiteral("\n");
    MenuId menu = MenuId::File;
    bool first = true;
    for (const ActionRow& row : actionRows()) {
        if (row.text == nullptr) continue;
        if (first || row.menu != menu) {
            page += QStringLiteral("\n## %1\n\n| %2 | %3 | |\n| --- | --- | --- |\n")
                        .arg(actions.menu(row.menu).title().remove(u'&'), ManualWindow::tr("command"),
                             ManualWindow::tr("keys"));
            menu = row.menu;
            first = false;
        }
        QStringList keys;
        for (const QKeySequence& key : actions[row.id].shortcuts())
            keys.append(key.toString(QKeySequence::NativeText));
        page += QStringLiteral("| %1 | %2 | %3 |\n")
                    .arg(actions[row.id].text().remove(u'&').remove(u'…'),
                         keys.join(QStringLiteral(", ")).replace(u'|', QStringLiteral("\\|")),
                         actions[row.id].statusTip());
    }
    return page;
}

QString hardCasesPage() {
    QString page = QStringLiteral("# %1\n\n").arg(ManualWindow::tr("Hard cases"));
    page += ManualWindow::tr(
        "Scenes that are hard to simulate and have a right answer, which their `expect` "
        "declarations ask for. The welcome page opens them; `carom test` judges them, and so "
        "does the Stability panel, beside those that are no scenes. The comment at the top of "
        "each says where its answer comes from.");
    page += QStringLiteral("\n\n| | %1 | %2 |\n| --- | --- | --- |\n")
                .arg(ManualWindow::tr("scene"), ManualWindow::tr("what is right"));
    for (const HardCase& row : sceneCases())
        page += QStringLiteral("| %1 | %2 | %3 |\n")
                    .arg(row.number)
                    .arg(textOf(row.title).replace(u'|', QStringLiteral("\\|")),
                         textOf(row.answer).replace(u'|', QStringLiteral("\\|")));
    return page;
}

ManualWindow::ManualWindow(const Actions& actions, QWidget* parent)
    : QWidget(parent, Qt::Window), m_contents(new QTreeWidget), m_text(new QTextBrowser),
      m_search(new QLineEdit) {
    setObjectName(QStringLiteral("manual"));
    setWindowTitle(tr("Manual – Carom"));
    const auto file = [](const char* name) {
        return QString::fromUtf8(resource(QStringLiteral("help/") + QString::fromLatin1(name)));
    };
    m_pages = {{QStringLiteral("tutorial"), tr("Ten minutes to a measured answer"), file("tutorial.md")},
               {QStringLiteral("expectations"), tr("State what must happen"), file("expectations.md")},
               {QStringLiteral("sweeps"), tr("From a laptop to a cluster"), file("sweeps.md")},
               {QStringLiteral("hardCases"), tr("Hard cases"), hardCasesPage()},
               {QStringLiteral("language"), tr("The scene language"), file("language.md")},
               {QStringLiteral("diagrams"), tr("Reading a work–precision diagram"), file("diagrams.md")},
               {QStringLiteral("keys"), tr("Shortcuts"), keysPage(actions)}};

    m_contents->setHeaderHidden(true);
    m_contents->setAccessibleName(tr("Contents of the manual"));
    m_text->setAccessibleName(tr("Manual"));
    m_text->setSearchPaths({QStringLiteral(":/help")});
    m_text->setOpenExternalLinks(true);
    m_search->setPlaceholderText(tr("Search the manual"));
    m_search->setAccessibleName(tr("Search the manual"));
    m_search->setClearButtonEnabled(true);

    QWidget* side = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(side);
    column->setContentsMargins(8, 8, 0, 8);
    column->addWidget(m_search);
    column->addWidget(m_contents, 1);
    QSplitter* splitter = new QSplitter;
    splitter->addWidget(side);
    splitter->addWidget(m_text);
    splitter->setSizes({contentsWidth, firstSize.width() - contentsWidth});
    splitter->setStretchFactor(1, 1);
    QVBoxLayout* whole = new QVBoxLayout(this);
    whole->setContentsMargins(0, 0, 0, 0);
    whole->addWidget(splitter);
    resize(firstSize);

    fillContents();
    showPage(0);
    connect(m_contents, &QTreeWidget::itemClicked, this, &ManualWindow::followContents);
    connect(m_contents, &QTreeWidget::itemActivated, this, &ManualWindow::followContents);
    connect(m_search, &QLineEdit::returnPressed, this, &ManualWindow::search);
}

void ManualWindow::open(const QString& page, const QString& heading, const QString& word) {
    show();
    raise();
    activateWindow();
    for (std::size_t i = 0; i < m_pages.size(); ++i)
        if (m_pages[i].id == page) showPage(i);
    goTo(heading, word);
}

void ManualWindow::openLanguage(const QString& title) {
    open(QStringLiteral("language"), title.section(u'.', 0, 0), title.section(u'.', 1));
}

void ManualWindow::fillContents() {
    for (std::size_t i = 0; i < m_pages.size(); ++i) {
        QTreeWidgetItem* page = new QTreeWidgetItem(m_contents, {m_pages[i].title});
        page->setData(0, pageRole, static_cast<qulonglong>(i));
        for (const auto& [level, heading] : headingsOf(m_pages[i].markdown)) {
            if (level == 1 || level > deepestHeading) continue;
            QTreeWidgetItem* parent = page;
            if (level > 2 && page->childCount() > 0) parent = page->child(page->childCount() - 1);
            QTreeWidgetItem* item = new QTreeWidgetItem(parent, {heading});
            item->setData(0, pageRole, static_cast<qulonglong>(i));
            item->setData(0, headingRole, heading);
        }
        page->setExpanded(true);
    }
}

void ManualWindow::showPage(std::size_t page) {
    if (page == m_shown && !m_text->document()->isEmpty()) return;
    m_shown = page;
    // One that nothing shows yet is laid out when it is complete, one on screen with every line that comes.
    QTextDocument* document = new QTextDocument(m_text);
    document->setDefaultFont(m_text->document()->defaultFont());
    document->setUndoRedoEnabled(false);
    document->setMarkdown(m_pages[page].markdown, QTextDocument::MarkdownDialectGitHub);
    addPictures(*document, m_pages[page].markdown, devicePixelRatioF());
    layOut(*document);
    const QPointer<QTextDocument> before = m_text->document(); // the browser ends its own, if it is that
    m_text->setDocument(document);
    delete before;
    m_text->verticalScrollBar()->setValue(0);
}

/// The heading's place at the top; then the word's, where a block below the heading begins with it.
void ManualWindow::goTo(const QString& heading, const QString& word) {
    const QTextDocument& document = *m_text->document();
    QTextBlock found;
    bool below = heading.isEmpty();
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        const bool isHeading = block.blockFormat().headingLevel() > 0;
        if (!below && isHeading &&
            block.text().section(QStringLiteral(" ("), 0, 0) == heading.section(QStringLiteral(" ("), 0, 0)) {
            found = block;
            below = true;
            if (word.isEmpty()) break;
        } else if (below && !word.isEmpty() && block.text().section(u' ', 0, 0) == word) {
            found = block;
            break;
        }
    }
    if (!found.isValid()) {
        m_text->verticalScrollBar()->setValue(0);
        return;
    }
    QTextCursor cursor(found);
    cursor.movePosition(QTextCursor::EndOfBlock, QTextCursor::KeepAnchor);
    m_text->setTextCursor(cursor);
    const double top = document.documentLayout()->blockBoundingRect(found).top();
    m_text->verticalScrollBar()->setValue(static_cast<int>(top) - margin);
}

void ManualWindow::followContents(const QTreeWidgetItem* item) {
    showPage(item->data(0, pageRole).toULongLong());
    goTo(item->data(0, headingRole).toString(), {});
}

/// Goes on from where one is, through all pages and around.
void ManualWindow::search() {
    const QString words = m_search->text();
    if (words.isEmpty() || m_text->find(words)) return;
    const std::size_t from = m_shown;
    for (std::size_t i = 1; i <= m_pages.size(); ++i) {
        const std::size_t page = (from + i) % m_pages.size();
        if (!m_pages[page].markdown.contains(words, Qt::CaseInsensitive)) continue;
        showPage(page);
        m_text->moveCursor(QTextCursor::Start);
        if (m_text->find(words)) return;
    }
}

void ManualWindow::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape)
        close();
    else
        QWidget::keyPressEvent(event);
}

} // namespace carom

#include "moc_manual_window.cpp"
