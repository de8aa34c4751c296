// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

#include <functional>
#include <thread>

namespace carom {

/// A panel's study on a thread of its own, one at a time. A member of the panel, and its last: the study has
/// ended before what it speaks to goes.
class StudyRunner : public QObject {
    Q_OBJECT
  public:
    using Finish = std::function<void()>; ///< on the GUI's thread, when the study's has ended
    /// On the study's thread: it ends soon after it is told to stop, and leaves widgets to Finish.
    using Work = std::function<Finish(const std::stop_token& stop)>;

    bool isRunning() const { return m_running; }
    /// Must not run yet.
    void start(Work work);
    void stop() { m_thread.request_stop(); }

  Q_SIGNALS:
    /// In place of Finish, where the study could not go on: "Stopped: ..., why".
    void failed(const QString& sentence);

  private:
    void end(const Finish& finish, const QString& problem);

    bool m_running = false;
    std::jthread m_thread;
};

} // namespace carom
