// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>

#include <vector>

class QLineEdit;
class QTextBrowser;
class QTreeWidget;
class QTreeWidgetItem;

namespace carom {

class Actions;

/// The manual: a tutorial, expectations, the language's reference, how to read the diagrams; the hard cases,
/// which are read off their scenes, and the keys, off the table of actions. A window of its own, so that it
/// can stand beside the scene.
class ManualWindow : public QWidget {
    Q_OBJECT
  public:
    explicit ManualWindow(const Actions& actions, QWidget* parent = nullptr);

    /// Shows the window at a heading of a page, or at a word below it; both may be empty.
    void open(const QString& page, const QString& heading = {}, const QString& word = {});
    /// What `sphere.radius`, `sphere` or a label's declaration is about: the place in the reference.
    void openLanguage(const QString& title);

  protected:
    void keyPressEvent(QKeyEvent* event) override;

  private:
    struct Page {
        QString id, title, markdown;
    };

    void fillContents();
    void showPage(std::size_t page);
    void goTo(const QString& heading, const QString& word);
    void followContents(const QTreeWidgetItem* item);
    void search();

    std::vector<Page> m_pages;
    std::size_t m_shown = 0;
    QTreeWidget* m_contents;
    QTextBrowser* m_text;
    QLineEdit* m_search;
};

/// Every action of the menus with its keys and what it does, as Markdown.
QString keysPage(const Actions& actions);
/// The hard cases that are scenes, with what is right, as Markdown.
QString hardCasesPage();

} // namespace carom
