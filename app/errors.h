// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cerrno>
#include <stdexcept>
#include <string>

// How a subcommand ends. Scripts depend on these numbers. The two errors below belong to the outside world,
// are thrown where they are met and become a message and an exit code in one place, runCommandLine.

namespace carom {

namespace exitcode {
inline constexpr int done = 0;
inline constexpr int sceneHasErrors = 1;
inline constexpr int wrongUsage = 2;
inline constexpr int fileError = 3;
inline constexpr int unphysical = 4; ///< the state is not finite, or energy has risen without a cause
inline constexpr int stabilityFailed = 5;
inline constexpr int expectationFailed = 5;
inline constexpr int interrupted = 130;
} // namespace exitcode

/// The command line asks for something it cannot have.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A file cannot be read or written.
class FileError : public std::runtime_error {
  public:
    /// "cannot write `scene.sdl`: No space left on device"; `cause` is an errno.
    FileError(const std::string& what, const std::string& path, int cause);
    /// The whole sentence at once.
    explicit FileError(const std::string& sentence, int cause = 0)
        : std::runtime_error(sentence), m_isBrokenPipe(cause == EPIPE) {}
    /// The reader of the output is gone (`carom ... | head`): no message is needed.
    bool isBrokenPipe() const { return m_isBrokenPipe; }

  private:
    bool m_isBrokenPipe;
};

/// An error of reading, for commands that continue with the next file.
class UnreadableFile : public FileError {
  public:
    UnreadableFile(const std::string& path, int cause) : FileError("cannot read", path, cause) {}
    explicit UnreadableFile(const std::string& sentence) : FileError(sentence) {}
};

/// A scene's text is longer than the language takes; it has errors, in a way.
class TextTooLarge : public std::runtime_error {
  public:
    explicit TextTooLarge(const std::string& name);
};

} // namespace carom
