// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/editor/scene_editor.h"
#include "ui/player/simulation.h"
#include "ui/base/actions.h"
#include "ui/base/pauses.h"
#include "ui/window/main_window.h"
#include "ui/window/workbench.h"

#include <QApplication>
#include <QTemporaryDir>
#include <QTest>

#include <functional>

// The whole IDE in a test, with settings of its own, driven by events as a user's hands would.

namespace carom::test {

/// How many times shorter the pauses of the program are in tests, where nobody needs them: a text is built 15
/// ms after the last key.
inline constexpr int shorterPauses = 10;

/// A QApplication as the program makes it, with an empty home.
class IdeApplication {
  public:
    IdeApplication(int& argumentCount, char** arguments) {
        qputenv("XDG_CONFIG_HOME", m_home.path().toLocal8Bit());
        qputenv("XDG_DATA_HOME", m_home.path().toLocal8Bit());
        m_application = std::make_unique<QApplication>(argumentCount, arguments);
        QApplication::setOrganizationName(QStringLiteral("carom-test"));
        QApplication::setApplicationName(QStringLiteral("carom-test"));
        shortenPauses(shorterPauses);
    }
    ~IdeApplication() {
        if (atEnd) atEnd();
    }
    IdeApplication(const IdeApplication&) = delete;
    IdeApplication& operator=(const IdeApplication&) = delete;

    /// What has to be gone before the application is.
    static inline std::function<void()> atEnd;

  private:
    QTemporaryDir m_home;
    std::unique_ptr<QApplication> m_application;
};

/// Puts the caret behind the first place that says `text`.
inline void placeCaretBehind(SceneEditor& editor, const QByteArray& text) {
    const qsizetype at = editor.bytes().indexOf(text);
    Q_ASSERT(at >= 0);
    editor.send(QsciScintillaBase::SCI_GOTOPOS, at + text.size());
}

/// Answers the next dialog as soon as it is there.
inline void answerNextDialog(std::function<void(QWidget&)> answer) {
    QTimer* timer = new QTimer(qApp);
    timer->setInterval(20);
    QObject::connect(timer, &QTimer::timeout, timer, [timer, answer] {
        QWidget* dialog = QApplication::activeModalWidget();
        if (dialog == nullptr) return;
        timer->deleteLater();
        timer->stop();
        answer(*dialog);
    });
    timer->start();
}

} // namespace carom::test
