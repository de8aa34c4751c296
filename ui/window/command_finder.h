// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>
#include <QPointer>
#include <QString>

#include <vector>

class QAction;
class QLabel;
class QLineEdit;
class QMainWindow;
class QTreeWidget;

namespace carom {

/// Everything the menus can do, found by writing a few letters of its name: Enter does it. Made from the
/// menus each time it opens, so nothing can be missing from it.
class CommandFinder : public QFrame {
    Q_OBJECT
  public:
    explicit CommandFinder(QMainWindow& window);

    void activate();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    struct Command {
        QAction* action = nullptr;
        QString path; ///< "View › World axes"
    };

    void collect();
    void narrow();
    void explain();
    void run();
    void close();

    QMainWindow& m_window;
    QLineEdit* m_words;
    QTreeWidget* m_list;
    QLabel* m_tip;
    std::vector<Command> m_commands;
    QPointer<QWidget> m_before; ///< had the keyboard
};

/// How well a text fits what was written: every word of `words` must occur in it. Less is better, beginnings
/// of words best; -1 where it does not fit.
int fitOf(const QString& text, const QString& words);

} // namespace carom
