// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/file_writer.h"

#include <QByteArray>
#include <QIODevice>
#include <QImage>
#include <QString>

#include <string>

// How everything the window writes comes to the disk: whole and beside the old file, which stays until the
// new one is there. Each returns what went wrong as a sentence, or an empty text.

namespace carom {

QString saveFile(const QString& path, const QByteArray& bytes);
inline QString saveFile(const QString& path, const std::string& text) {
    return saveFile(path, QByteArray::fromStdString(text));
}

/// As PNG.
QString saveImage(const QString& path, const QImage& picture);

/// The bytes of another file, however many.
QString saveCopy(const QString& path, const QString& original);

/// The same for what is written piece by piece. Without a commit the old file stays.
class OutputDevice : public QIODevice {
  public:
    explicit OutputDevice(const QString& path);
    /// Everything written so far, or the whole at the end.
    QString problem() const;
    QString commit();

  protected:
    qint64 readData(char*, qint64) override { return -1; }
    qint64 writeData(const char* bytes, qint64 count) override;

  private:
    QString m_path;
    FileWriter m_file;
};

/// "`video.gif` cannot be written: No space left on device".
QString notWritten(const QString& path, const QString& reason);

} // namespace carom
