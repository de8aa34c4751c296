// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/build.h"

#include <QByteArray>
#include <QObject>
#include <QThreadPool>
#include <QTimer>

#include <cstdint>
#include <functional>
#include <memory>

namespace carom {

/// What one revision of the text means.
struct BuildResult {
    std::int64_t revision = 0;
    bool fresh = false; ///< the first of a text just opened, not an edit of it
    double milliseconds = 0;
    Build build;

    const Scene& scene() const { return build.analysis.scene; }
};

using SharedBuild = std::shared_ptr<const BuildResult>;

/// Builds the text once typing pauses. Ordinary texts take a few milliseconds and are built at once; long
/// ones on a thread of their own, so that typing never waits. A result that was overtaken by another edit is
/// dropped.
class LiveBuild : public QObject {
    Q_OBJECT
  public:
    explicit LiveBuild(std::function<QByteArray()> text, QObject* parent = nullptr);
    ~LiveBuild() override;

    /// The text is at this revision now; it will be built when it has rested for 150 ms.
    void textEdited(std::int64_t revision);
    /// For simulating what is built from now on; 0: as the scene or the machine says.
    void setThreads(int count) { m_threads = count; }
    /// What was typed last is built without waiting for rest: a number is being turned and the picture
    /// follows.
    void hurry();
    /// Another text altogether: built now.
    void textReplaced(std::int64_t revision);

    /// The newest result; null before the first.
    const SharedBuild& latest() const { return m_latest; }
    bool isCurrent() const { return m_latest && m_latest->revision == m_revision; }

  Q_SIGNALS:
    void built(const carom::SharedBuild& result);

  private:
    void start();
    void deliver(SharedBuild result);

    std::function<QByteArray()> m_text;
    std::int64_t m_revision = 0;
    bool m_fresh = false;
    int m_threads = 0;
    SharedBuild m_latest;
    QTimer m_idle;
    QThreadPool m_worker;
};

} // namespace carom
