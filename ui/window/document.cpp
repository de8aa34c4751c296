// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/document.h"

#include "core/base/hash.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSaveFile>

#include <algorithm>
#include <cstring>

namespace carom {
namespace {

constexpr qint64 longestText = 64LL << 20; // [bytes], the language's own limit

/// Of words of eight bytes: it is to tell texts apart, and to take no time for a long one.
std::uint64_t hashOf(const QByteArray& bytes) {
    Hash64 hash;
    for (qsizetype at = 0; at < bytes.size(); at += qsizetype{sizeof(std::uint64_t)}) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at,
                    static_cast<std::size_t>(std::min(qsizetype{sizeof word}, bytes.size() - at)));
        hash.add(word);
    }
    hash.add(static_cast<std::uint64_t>(bytes.size()));
    return hash.value();
}

} // namespace

Document::Document(TextBuffer& buffer, QObject* parent) : QObject(parent), m_buffer(buffer) {
    connect(&m_watcher, &QFileSystemWatcher::fileChanged, this, [this](const QString& path) {
        QFile file(path);
        if (!file.open(QIODevice::ReadOnly)) return; // moved or deleted: the text here is all there is
        if (hashOf(file.readAll()) != m_onDisk) Q_EMIT changedOutside();
        if (!m_watcher.files().contains(path)) m_watcher.addPath(path); // replaced files drop out
    });
}

QString Document::name() const {
    return m_path.isEmpty() ? QStringLiteral("untitled.sdl") : QFileInfo(m_path).fileName();
}

std::optional<QString> Document::open(const QString& path) {
    const QFileInfo info(path);
    if (info.isDir()) return tr("“%1” is a folder; choose a scene file in it").arg(path);
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) return tr("“%1” cannot be read: %2").arg(path, file.errorString());
    if (file.size() > longestText)
        return tr("“%1” has %2 MiB; a scene's text may have 64 MiB").arg(path).arg(file.size() >> 20);
    const QByteArray bytes = file.readAll();
    if (file.error() != QFileDevice::NoError)
        return tr("“%1” cannot be read: %2").arg(path, file.errorString());
    m_onDisk = hashOf(bytes);
    take(info.absoluteFilePath(), bytes);
    return std::nullopt;
}

std::optional<QString> Document::save() { return saveAs(m_path); }

std::optional<QString> Document::saveAs(const QString& path) {
    if (path.isEmpty()) return tr("the text has no file yet; choose a name for it");
    const QByteArray bytes = m_buffer.bytes();
    QSaveFile file(path); // written aside and renamed: the old file stays until the new one is whole
    const bool written = file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
    if (!m_path.isEmpty()) m_watcher.removePath(m_path); // our own writing is no change outside
    const bool saved = written && file.commit();
    if (!saved) {
        watch(m_path);
        return tr("“%1” cannot be written: %2").arg(path, file.errorString());
    }
    m_onDisk = hashOf(bytes);
    m_buffer.markSaved();
    watch(QFileInfo(path).absoluteFilePath());
    Q_EMIT pathChanged(m_path);
    return std::nullopt;
}

void Document::startNew(const QByteArray& text) { take({}, text); }

void Document::recover(const QString& path, const QByteArray& text) {
    take(path, text);
    m_buffer.markUnsaved();
}

void Document::noteEdit() { Q_EMIT edited(++m_revision); }

void Document::take(const QString& path, const QByteArray& text) {
    watch(path);
    const bool wasBlocked = blockSignals(true); // one signal for the whole exchange, not one an edit
    m_buffer.setBytes(text);
    blockSignals(wasBlocked);
    ++m_revision;
    Q_EMIT pathChanged(m_path);
    Q_EMIT replaced();
}

void Document::watch(const QString& path) {
    if (!m_path.isEmpty()) m_watcher.removePath(m_path);
    m_path = path;
    if (QFileInfo::exists(path)) m_watcher.addPath(path);
}

} // namespace carom
