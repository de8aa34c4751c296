// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/file_writer.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace carom {
namespace {

namespace fs = std::filesystem;

constexpr mode_t anyWriter = S_IWUSR | S_IWGRP | S_IWOTH;
constexpr mode_t ownerOnly = S_IRUSR | S_IWUSR;
constexpr mode_t forEverybody =
    ownerOnly | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH; // less what the umask takes
constexpr mode_t permissions = 07777;
constexpr int mostLinks = 40; // as the kernel follows

/// Where a chain of symbolic links ends; the file itself need not be there.
std::string behindLinks(const std::string& path) {
    fs::path place = path;
    std::error_code error;
    for (int i = 0; i < mostLinks && fs::is_symlink(place, error); ++i) {
        const fs::path target = fs::read_symlink(place, error);
        if (error) break;
        place = target.is_absolute() ? target : place.parent_path() / target;
    }
    return place.string();
}

/// Read-only for everybody. Root could write it, but must not do so silently.
bool isReadOnly(const struct stat& file) { return (file.st_mode & anyWriter) == 0; }

std::string folderOf(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    return folder.empty() ? "." : folder.string();
}

/// A new file in that folder, its name in `path`; -1 and errno where there can be none.
int openNewFile(const std::string& folder, mode_t mode, std::string& path) {
    static std::atomic<unsigned> next = 0;
    for (;;) {
        path = folder + "/.carom-" + std::to_string(::getpid()) + "-" + std::to_string(next++);
        const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (descriptor >= 0 || (errno != EEXIST && errno != EINTR)) return descriptor;
    }
}

} // namespace

FileWriter::FileWriter(const std::string& path, FileReaders readers) : m_place(behindLinks(path)) {
    open(readers);
}

FileWriter::~FileWriter() {
    if (m_descriptor >= 0) ::close(m_descriptor);
    if (!m_beside.empty()) ::unlink(m_beside.c_str());
}

void FileWriter::open(FileReaders readers) {
    struct stat original {};
    const bool exists = ::stat(m_place.c_str(), &original) == 0;
    if (!exists && errno != ENOENT) {
        fail(errno);
        return;
    }
    if (exists && S_ISDIR(original.st_mode)) {
        fail(EISDIR);
        return;
    }
    if (exists && !S_ISREG(original.st_mode)) {
        m_descriptor = ::open(m_place.c_str(), O_WRONLY | O_CLOEXEC);
        if (m_descriptor < 0) fail(errno);
        return;
    }
    // Renaming asks for the folder's permission only.
    if (exists && (isReadOnly(original) || ::access(m_place.c_str(), W_OK) != 0)) {
        fail(EACCES);
        return;
    }
    const mode_t mode = exists || readers == FileReaders::OwnerOnly ? ownerOnly : forEverybody;
    m_descriptor = openNewFile(folderOf(m_place), mode, m_beside);
    if (m_descriptor < 0) {
        const int cause = errno;
        m_beside.clear();
        fail(cause);
        return;
    }
    if (exists) keepOwner(original);
}

bool FileWriter::keepOwner(const struct stat& original) {
    // Only root can give another user's file back to them; for everyone else it stays readable as it was.
    if (::fchown(m_descriptor, original.st_uid, original.st_gid) != 0) errno = 0;
    return ::fchmod(m_descriptor, original.st_mode & permissions) == 0 || fail(errno);
}

bool FileWriter::write(std::string_view bytes) {
    while (m_error == 0 && !bytes.empty()) {
        const ssize_t count = ::write(m_descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return fail(errno);
        m_written += count;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return m_error == 0;
}

bool FileWriter::commit() {
    if (m_error != 0) return false;
    if (m_beside.empty()) return closeDescriptor();
    return sizeIsRight() && (::fsync(m_descriptor) == 0 || fail(errno)) && closeDescriptor() && rename();
}

/// A full file system may report the error late, so the size of the written file is checked.
bool FileWriter::sizeIsRight() {
    struct stat written {};
    if (::fstat(m_descriptor, &written) != 0) return fail(errno);
    return written.st_size == m_written || fail(ENOSPC);
}

bool FileWriter::closeDescriptor() {
    const int descriptor = m_descriptor;
    m_descriptor = -1;
    // Where close was interrupted the descriptor is gone all the same.
    return ::close(descriptor) == 0 || errno == EINTR || fail(errno);
}

bool FileWriter::rename() {
    if (::rename(m_beside.c_str(), m_place.c_str()) != 0) return fail(errno);
    m_beside.clear();
    const int folder = ::open(folderOf(m_place).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return true; // a folder one may write and not read
    // EINVAL: a file system that knows no such thing.
    const int problem = ::fsync(folder) == 0 || errno == EINVAL ? 0 : errno;
    ::close(folder);
    return problem == 0 || fail(problem);
}

bool FileWriter::fail(int cause) {
    m_error = cause;
    return false;
}

std::string FileWriter::errorText() const {
    return m_error == 0 ? std::string() : whyNotWritten(m_place, m_error);
}

std::string whyNotWritten(const std::string& path, int cause) {
    const std::string folder = folderOf(path);
    std::error_code error;
    if (cause == ENOENT && !fs::exists(folder, error)) return "there is no folder `" + folder + "`";
    struct stat file {};
    const bool isThere = ::stat(path.c_str(), &file) == 0;
    if (cause == EACCES && isThere && isReadOnly(file)) return "the file is read-only";
    return std::generic_category().message(cause);
}

std::string writeWholeFile(const std::string& path, std::string_view bytes, FileReaders readers) {
    FileWriter file(path, readers);
    if (file.write(bytes) && file.commit()) return {};
    return file.errorText();
}

} // namespace carom
