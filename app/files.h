// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Files as the subcommands use them: `-` is standard input or output, and every error is reported: a full
// disk at the latest when the file is closed. Everything here throws FileError.

namespace carom {

/// The text of a scene, all of it. Throws UnreadableFile, also for a folder, a device or a named pipe, which
/// may never end; a pipe that the shell has opened is read. Throws TextTooLarge for more than the language
/// takes.
std::string readText(const std::string& path);

/// How messages name a scene: its path, or `<stdin>`.
std::string displayName(const std::string& path);

/// What a scene is called in tables and folders: its file without folder and ending.
std::string titleOf(const std::string& path);

/// A text file being written as its content is found; what was written stays if the program stops early.
class OutputFile {
  public:
    explicit OutputFile(const std::string& path); ///< `-` is standard output
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view text);
    /// Hands what was written so far to the system: it remains however this program ends.
    void flush();
    /// Closes the file; throws FileError if anything was not written.
    void close();

  private:
    void send(std::string_view text);
    [[noreturn]] void fail() const;

    std::string m_path;
    std::string m_waiting;
    int m_descriptor;
};

/// A file the command line names, and what for: "`--trace`", "the scene".
struct NamedFile {
    std::string purpose, path;
};

/// Throws UsageError where two of them are one file, by whatever names and links: the later would overwrite
/// the earlier. Devices and pipes may be named twice; an empty path is none.
void refuseSharedFiles(const std::vector<NamedFile>& files);

/// Makes a folder and those above it; one that exists already is fine.
void makeFolder(const std::string& path);
/// Writes a whole text file into a folder, beside the old one, which stays until the new one is there.
void writeFile(const std::string& folder, const std::string& name, std::string_view text);

/// Writes results that will be written again when there are more: a disk that is full now may have room then.
/// A failure is reported once, and the work continues.
class InterimResults {
  public:
    explicit InterimResults(std::string who) : m_who(std::move(who)) {}
    void write(const std::function<void()>& files);

  private:
    std::string m_who; ///< "carom study gas"
    bool m_failed = false;
};

/// Writes all of `text` to standard output.
void printOut(std::string_view text);
/// Writes to standard error, where nothing more can be done if it fails.
void printError(std::string_view text);

/// Writes a whole file in the place of the old one: readers see the old text or the new, never a part.
void replaceFile(const std::string& path, std::string_view text);

} // namespace carom
