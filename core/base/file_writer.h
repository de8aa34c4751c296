// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

struct stat;

namespace carom {

/// Permissions of a new file. One that is replaced keeps its own.
enum class FileReaders { Everybody, OwnerOnly };

/// Replaces a file as a whole: readers see the old content or the new, never a part, whatever fails and
/// whenever the program or the machine stops.
///
///     write … → a file beside it;  commit → size checked, on the disk, renamed, the rename on the disk
///
/// Symbolic links are followed. A file that nobody may write (mode 0444) is left alone, even by root. What is
/// no file at all, /dev/null or a pipe, is written as it is.
class FileWriter {
  public:
    explicit FileWriter(const std::string& path, FileReaders readers = FileReaders::Everybody);
    ~FileWriter(); ///< without a commit the old file stays, and nothing beside it
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    /// Each returns whether everything has gone well so far; after a failure nothing more is done.
    bool write(std::string_view bytes);
    bool commit();

    /// Why something failed: an errno, 0 for nothing.
    int error() const { return m_error; }
    /// The same in words.
    std::string errorText() const;

  private:
    void open(FileReaders readers);
    bool fail(int cause);
    bool closeDescriptor();
    bool keepOwner(const struct stat& original);
    bool sizeIsRight();
    bool rename();

    std::string m_place;  ///< with links followed
    std::string m_beside; ///< what is written, empty where the place itself is
    int m_descriptor = -1;
    long long m_written = 0; ///< [bytes]
    int m_error = 0;
};

/// Why a file cannot be written, in words: "No space left on device", "there is no folder `results`", "the
/// file is read-only". `cause` is an errno.
std::string whyNotWritten(const std::string& path, int cause);

/// All of it in one call; what went wrong in words, or an empty text.
std::string writeWholeFile(const std::string& path, std::string_view bytes,
                           FileReaders readers = FileReaders::Everybody);

} // namespace carom
