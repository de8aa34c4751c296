// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/window/document.h"

#include <QDateTime>
#include <QLockFile>
#include <QObject>
#include <QString>
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
};

/// Keeps a copy of unsaved text in a swap file, at most two seconds behind, until it is saved or given up. A
/// thread of its own writes it: typing does not wait for the disk.
/// A swap file is held by a lock; one whose lock nobody holds was left by a crash.
class Recovery : public QObject {
    Q_OBJECT
  public:
    static constexpr int interval = 2000; ///< [ms]

    Recovery(const Document& document, const QString& folder, QObject* parent = nullptr);
    ~Recovery() override;

    /// Where swap files of this user lie.
    static QString standardFolder();
    /// What crashed sessions left, newest first.
    static std::vector<LostText> lostTexts(const QString& folder);
    static void discard(const LostText& lost);

    /// Brings the swap file up to date now.
    void keep();

  private:
    void keepBehind();

    const Document& m_document;
    QString m_swapFile;
    std::unique_ptr<QLockFile> m_lock;
    std::int64_t m_kept = -1; ///< the revision in the swap file
    bool m_writing = false;   ///< on the thread
    QTimer m_timer;
    QThreadPool m_writer;
};

} // namespace carom
