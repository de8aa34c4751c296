// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QFileSystemWatcher>
#include <QObject>
#include <QString>
#include <QTimer>

#include <cstdint>
#include <functional>
#include <optional>

namespace carom {

/// Where the bytes of a text live while it is edited; the editor widget is one.
class TextBuffer {
  public:
    virtual ~TextBuffer() = default;
    TextBuffer() = default;
    TextBuffer(const TextBuffer&) = delete;
    TextBuffer& operator=(const TextBuffer&) = delete;

    virtual QByteArray bytes() const = 0;
    /// Replaces everything, forgets the undo history and counts as saved.
    virtual void setBytes(const QByteArray& bytes) = 0;
    virtual bool differsFromSaved() const = 0;
    virtual void markSaved() = 0;
    /// The text no longer equals what is on disk, whatever the undo history says.
    virtual void markUnsaved() = 0;
    /// Replaces everything in one step that can be undone, and counts as saved.
    virtual void exchangeBytes(const QByteArray& bytes) = 0;
};

/// A text's file compared with what was read from it, or written to it, last.
enum class OnDisk { AsKnown, Changed, Missing };

/// The sole holder of the text's state: where it is kept, which revision it is at, whether it is saved. Bytes
/// are taken and written as they are: line ends, a byte order mark and even invalid UTF-8 survive.
class Document : public QObject {
    Q_OBJECT
  public:
    explicit Document(TextBuffer& buffer, QObject* parent = nullptr);

    /// Empty for a text that has never been saved.
    const QString& path() const { return m_path; }
    /// What a title bar shows: the file's name or "untitled.sdl".
    QString name() const;
    /// Grows with every change of the text.
    std::int64_t revision() const { return m_revision; }
    bool isModified() const { return m_buffer.differsFromSaved(); }
    QByteArray text() const { return m_buffer.bytes(); }

    /// Each returns what went wrong as a sentence, or nothing. A failed call changes nothing.
    std::optional<QString> open(const QString& path);
    std::optional<QString> save();
    std::optional<QString> saveAs(const QString& path);
    /// The file's text in place of this one: one step that can be undone.
    std::optional<QString> reload();
    /// Looks at the file now. Whoever saves over a changed one asks first.
    OnDisk onDisk() const;
    /// What is in the file now, to be shown: changedOutside() does not tell of it again. Empty where nothing
    /// can be read.
    QByteArray seeTextOnDisk();
    /// A text without a file.
    void startNew(const QByteArray& text);
    /// Recovers a text that was never saved, as it was left; `path` is the file it belongs to, or empty.
    void recover(const QString& path, const QByteArray& text);

    /// The editor calls this after each change of the buffer.
    void noteEdit();

  Q_SIGNALS:
    void edited(std::int64_t revision);
    /// Another text has taken the place of the old one.
    void replaced();
    void pathChanged(const QString& path);
    /// Somebody else has written the file, and is done. Once for every text it gets.
    void changedOutside();
    /// Somebody has deleted or moved the file; the text counts as unsaved.
    void removedOutside();

  private:
    void take(const QString& path, const QByteArray& text);
    void watch(const QString& path);
    void exchange(const std::function<void()>& change);
    void look();

    TextBuffer& m_buffer;
    QString m_path;
    std::int64_t m_revision = 0;
    std::uint64_t m_known = 0;           ///< hash of what we last read or wrote
    std::optional<std::uint64_t> m_seen; ///< hash of what was in the file when we last looked; none: no file
    QFileSystemWatcher m_watcher;        ///< of the file and its folder, where a file may come back
    QTimer m_quiet{this};                ///< until whoever writes is done
    int m_emptyLooks = 0;                ///< looks in a row at a file that has become empty
};

} // namespace carom
