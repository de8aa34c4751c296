// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

// Files as the subcommands use them: `-` is standard input or output, and no error goes unseen: a full disk
// shows at the latest when the file is closed. Everything here throws FileError.

namespace carom {

/// The text of a scene, all of it. More than the language takes (64 MiB) is not read: one byte beyond is
/// enough for the analysis to say so, and an endless stream ends. Throws UnreadableFile.
std::string readText(const std::string& path);

/// How messages name a scene: its path, or `<stdin>`.
std::string displayName(const std::string& path);

/// A text file being written; what was written stays if the program stops early.
class OutputFile {
  public:
    explicit OutputFile(const std::string& path); ///< `-` is standard output
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view text);
    /// Everything is on its way, or FileError.
    void close();

  private:
    [[noreturn]] void fail() const;

    std::string m_path;
    std::FILE* m_file;
};

/// Makes a folder and those above it; one that exists already is fine.
void makeFolder(const std::string& path);
/// Writes a whole text file into a folder.
void writeFile(const std::string& folder, const std::string& name, std::string_view text);

/// Writes all of `text` to standard output.
void printOut(std::string_view text);
/// Writes to standard error, where nothing more can be done if it fails.
void printError(std::string_view text);

/// Replaces the file's content at once: readers see the old text or the new, never a part. Links are
/// followed, permissions kept.
void replaceFile(const std::string& path, std::string_view text);

} // namespace carom
