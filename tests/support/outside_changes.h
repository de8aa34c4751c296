// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/files.h"

#include "ui/base/document.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

// That a document does not tell of a change is seen when it has looked at it, however long that takes.

namespace carom::test {

/// A text that is on no screen.
class PlainBuffer : public TextBuffer {
  public:
    QByteArray content, saved;

    QByteArray bytes() const override { return content; }
    void setBytes(const QByteArray& bytes) override { content = saved = bytes; }
    bool differsFromSaved() const override { return content != saved; }
    void markSaved() override { saved = content; }
    void markUnsaved() override { saved = content + '?'; }
    void exchangeBytes(const QByteArray& bytes) override { content = saved = bytes; }
};

/// Returns when all documents have looked at what was written before: a document beside them has told of two
/// changes, one after the other. What was written before has reached the others by the first, so that their
/// pauses began before the second one's and are over. False if it never tells.
inline bool allHaveLooked() {
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("later.sdl"));
    writeFile(path, "one");
    PlainBuffer buffer;
    Document document(buffer);
    if (document.open(path)) return false;
    const QSignalSpy told(&document, &Document::changedOutside);
    for (const int changes : {1, 2}) {
        writeFile(path, QByteArray::number(changes));
        if (!QTest::qWaitFor([&] { return told.count() == changes; }, longestWait)) return false;
    }
    return true;
}

} // namespace carom::test
