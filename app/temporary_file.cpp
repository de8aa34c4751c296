// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/temporary_file.h"

#include "app/errors.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace carom {

TemporaryFile::TemporaryFile(const std::string& besides) : m_path(besides + ".XXXXXX") {
    const int descriptor = ::mkstemp(m_path.data());
    if (descriptor < 0) throw FileError("cannot write beside", "`" + besides + "`", errno);
    ::close(descriptor);
}

TemporaryFile::~TemporaryFile() { ::unlink(m_path.c_str()); }

} // namespace carom
