// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/clock.h"
#include "core/language/navigation.h"
#include "core/simulation/build.h"

#include <QByteArray>
#include <QObject>
#include <QString>
#include <QThreadPool>
#include <QTimer>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace carom {

/// What one revision of the text means.
struct BuildResult {
    std::int64_t revision = 0;
    bool fresh = false; ///< the first of a text just opened, not an edit of it
    double milliseconds = 0;
    Build build;
    std::vector<OutlineEntry> outline; ///< points into the text
    /// The same for texts that differ in comments and white space at most.
    std::uint64_t meaning = 0;

    const Scene& scene() const { return build.analysis.scene; }
};

using SharedBuild = std::shared_ptr<const BuildResult>;

/// Builds the text once typing pauses. Ordinary texts take a few milliseconds and are built at once; long
/// ones on a thread of their own, so that typing never waits. It says how far a build is that takes longer
/// than one waits without asking. Another edit ends it, as cancel() does.
class LiveBuild : public QObject {
    Q_OBJECT
  public:
    explicit LiveBuild(std::function<QByteArray()> text, QObject* parent = nullptr);
    ~LiveBuild() override;

    /// The text is at this revision now; it will be built when it has rested for a pause of 150 ms.
    void textEdited(std::int64_t revision);
    /// For simulating what is built from now on; 0: as many as the machine has.
    void setThreads(int count) { m_threads = count; }
    /// What was typed last is built without waiting for rest: a number is being turned and the picture
    /// follows.
    void hurry();
    /// Another text altogether: built now.
    void textReplaced(std::int64_t revision);
    /// Gives up the build under way; the text is built after its next edit.
    void cancel();
    /// How long a build may take before progressed() tells of it [ms].
    void setProgressDelay(int milliseconds) { m_progressDelay = milliseconds; }

    /// The newest result; null before the first.
    const SharedBuild& latest() const { return m_latest; }
    bool isCurrent() const { return m_latest && m_latest->revision == m_revision; }

  Q_SIGNALS:
    void built(const carom::SharedBuild& result);
    /// A build takes its time: the part done, 0..1, and the seconds left; ten times a second.
    void progressed(double done, double secondsLeft);
    /// The build under way is none any more: it is built, overtaken or cancelled.
    void ended();
    /// By cancel(), and there was a build.
    void cancelled();
    /// The build ended by an exception: memory ran out. What was built before stays.
    void failed(const QString& problem);

  private:
    /// What the thread that builds and the GUI's share.
    struct Work {
        std::atomic<bool> wanted = true;
        std::atomic<double> done = 0; ///< 0..1
    };

    void start();
    void tell();
    void stop();
    void deliver(SharedBuild result);

    std::function<QByteArray()> m_text;
    std::int64_t m_revision = 0;
    bool m_fresh = false;
    int m_threads = 0;
    int m_progressDelay = 300; ///< [ms]
    SharedBuild m_latest;
    std::shared_ptr<Work> m_work; ///< of the build under way on the thread; null: none is
    Stopwatch m_since;            ///< it began
    QTimer m_look;
    QTimer m_idle;
    QThreadPool m_worker;
};

} // namespace carom
