// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/study_runner.h"

#include "core/base/assert.h"
#include "ui/base/failures.h"

#include <QMetaObject>

namespace carom {

void StudyRunner::start(Work work) {
    ASSERT(!m_running);
    m_running = true;
    m_thread = std::jthread([this, work = std::move(work)](const std::stop_token& stop) {
        Finish finish;
        const QString problem = attempt([&] { finish = work(stop); });
        QMetaObject::invokeMethod(
            this, [this, finish, problem] { end(finish, problem); }, Qt::QueuedConnection);
    });
}

void StudyRunner::end(const Finish& finish, const QString& problem) {
    m_thread.join();
    m_running = false;
    if (problem.isEmpty())
        finish();
    else
        Q_EMIT failed(tr("Stopped: %1").arg(problem));
}

} // namespace carom

#include "moc_study_runner.cpp"
