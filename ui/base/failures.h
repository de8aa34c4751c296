// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QApplication>
#include <QString>

#include <exception>

// Where exceptions end: a thread's function and Qt's event loop let none through. What failed is said; text,
// runs and results stay.

namespace carom {

/// "there is not enough memory for it", of the exception being handled.
QString failureInWords();

/// Does the work of a thread and lets no exception out: what went wrong, or an empty text.
template<class Work>
QString attempt(const Work& work) {
    try {
        work();
        return {};
    } catch (...) {
        return failureInWords();
    }
}

/// A QApplication in which what fails on an event ends that event only, and numbers look as in scenes.
class Application : public QApplication {
    Q_OBJECT
  public:
    Application(int& argumentCount, char** arguments);

    bool notify(QObject* receiver, QEvent* event) override;

  Q_SIGNALS:
    void failed(const QString& sentence);
};

} // namespace carom
