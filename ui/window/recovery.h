// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/base/document.h"
#include "ui/base/settings.h"

#include <QDateTime>
#include <QLockFile>
#include <QObject>
#include <QString>
#include <QStringList>
#include <QThreadPool>
#include <QTimer>

#include <cstdint>
#include <memory>
#include <vector>

namespace carom {

/// A text that a session which did not end by itself left behind.
struct LostText {
    QString swapFile;
    QString path; ///< the scene file it belongs to; empty if it had none
    QByteArray text;
    QDateTime written;
    std::shared_ptr<QLockFile> lock{}; ///< nobody else offers it while this value lives
};

/// What a look into the folder of swap files found.
struct LostTexts {
    std::vector<LostText> texts; ///< newest first
    QStringList unreadable;      ///< swap files that are there and cannot be read; they stay
};

/// Keeps a copy of unsaved text in a swap file, at most an interval behind, until it is saved or given up. A
/// thread of its own writes it: typing does not wait for the disk.
/// A swap file is held by a lock; one whose lock nobody holds was left by a crash. Only its owner may read
/// it.
class Recovery : public QObject {
    Q_OBJECT
  public:
    static constexpr int defaultInterval = Settings::defaultRecoveryInterval; ///< [ms]

    Recovery(const Document& document, const QString& folder, int interval = defaultInterval,
             QObject* parent = nullptr);
    ~Recovery() override;

    /// Where swap files of this user lie.
    static QString standardFolder();
    /// What crashed sessions left. A swap file that says what its scene's file says is removed, and so is a
    /// lock that holds nothing.
    static LostTexts lostTexts(const QString& folder);
    static void discard(const LostText& lost);

    /// Brings the swap file up to date now; whether unsaved text, if there is any, is in it.
    bool keep();

  Q_SIGNALS:
    /// Unsaved text cannot be kept, and why; empty: it can again. Said once for each reason.
    void keepingChanged(const QString& problem);

  private:
    void keepBehind();
    void note(std::int64_t revision, const QString& problem);

    const Document& m_document;
    QString m_swapFile;
    std::unique_ptr<QLockFile> m_lock;
    std::int64_t m_kept = -1; ///< the revision in the swap file
    QString m_problem;        ///< of the last time it was written
    bool m_writing = false;   ///< on the thread
    QTimer m_timer;
    QThreadPool m_writer;
};

} // namespace carom
