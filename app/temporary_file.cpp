// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/temporary_file.h"

#include "app/errors.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

namespace carom {

TemporaryFile::TemporaryFile(const std::string& besides) : m_path(besides + ".XXXXXX") {
    m_descriptor = ::mkstemp(m_path.data());
    if (m_descriptor < 0) throw FileError("cannot write beside", "`" + besides + "`", errno);
}

TemporaryFile::~TemporaryFile() {
    if (m_descriptor >= 0) ::close(m_descriptor);
    if (!m_renamed) ::unlink(m_path.c_str());
}

void TemporaryFile::write(std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(m_descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail();
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

void TemporaryFile::takeOwnerOf(const struct stat& original) {
    // Another user's file stays readable as it was, but may change hands: only root can prevent that.
    if (::fchown(m_descriptor, original.st_uid, original.st_gid) != 0) errno = 0;
    if (::fchmod(m_descriptor, original.st_mode & 07777U) != 0) fail();
}

void TemporaryFile::renameTo(const std::string& path) {
    if (::fsync(m_descriptor) != 0) fail();
    const int descriptor = m_descriptor;
    m_descriptor = -1;
    if (::close(descriptor) != 0) fail();
    if (std::rename(m_path.c_str(), path.c_str()) != 0)
        throw FileError("cannot replace", "`" + path + "`", errno);
    m_renamed = true;
}

void TemporaryFile::fail() const { throw FileError("cannot write", "`" + m_path + "`", errno); }

} // namespace carom
