// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/file_output.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QFile>

namespace carom {

QString saveFile(const QString& path, const QByteArray& bytes) {
    OutputDevice file(path);
    file.write(bytes);
    return file.commit();
}

QString saveImage(const QString& path, const QImage& picture) {
    QBuffer bytes;
    bytes.open(QIODevice::WriteOnly);
    if (!picture.save(&bytes, "PNG"))
        return notWritten(path, QCoreApplication::translate("carom", "there is no picture"));
    return saveFile(path, bytes.data());
}

QString saveCopy(const QString& path, const QString& original) {
    constexpr qint64 block = 1 << 20; // [bytes]
    QFile source(original);
    if (!source.open(QIODevice::ReadOnly)) return notWritten(path, source.errorString());
    OutputDevice file(path);
    while (!source.atEnd() && file.problem().isEmpty()) {
        const QByteArray bytes = source.read(block);
        if (source.error() != QFileDevice::NoError) return notWritten(path, source.errorString());
        file.write(bytes);
    }
    return file.commit();
}

OutputDevice::OutputDevice(const QString& path)
    : m_path(path), m_file(QFile::encodeName(path).toStdString()) {
    open(QIODevice::WriteOnly | QIODevice::Unbuffered);
}

QString OutputDevice::problem() const {
    return m_file.error() == 0 ? QString() : notWritten(m_path, QString::fromStdString(m_file.errorText()));
}

QString OutputDevice::commit() {
    m_file.commit();
    return problem();
}

qint64 OutputDevice::writeData(const char* bytes, qint64 count) {
    return m_file.write({bytes, static_cast<std::size_t>(count)}) ? count : -1;
}

QString notWritten(const QString& path, const QString& reason) {
    return QCoreApplication::translate("carom", "`%1` cannot be written: %2").arg(path, reason);
}

} // namespace carom
