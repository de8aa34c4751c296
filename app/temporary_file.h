// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

struct stat;

namespace carom {

/// A file that is gone again when this is, unless it was renamed. Everything here throws FileError.
class TemporaryFile {
  public:
    /// Its path is `besides` with an ending of its own.
    explicit TemporaryFile(const std::string& besides);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::string& path() const { return m_path; }
    void write(std::string_view text);
    void takeOwnerOf(const struct stat& original);
    void renameTo(const std::string& path);

  private:
    [[noreturn]] void fail() const;

    std::string m_path;
    int m_descriptor = -1;
    bool m_renamed = false;
};

} // namespace carom
