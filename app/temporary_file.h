// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace carom {

/// An empty file for another program to write into; deleted with this object. Throws FileError.
class TemporaryFile {
  public:
    /// Its path is `besides` with an ending of its own.
    explicit TemporaryFile(const std::string& besides);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::string& path() const { return m_path; }

  private:
    std::string m_path;
};

} // namespace carom
