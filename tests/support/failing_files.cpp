// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/failing_files.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

// Nothing here may allocate where nothing fails: it stands in the way of every file of the process.

namespace {

struct Fault {
    std::array<char, 16> call{};
    std::array<char, PATH_MAX> folder{};
    std::atomic<int> left = 0; ///< calls that still succeed
    int cause = 0;
    std::atomic<bool> armed = false;
    std::atomic<int> failures = 0;
};

Fault fault;

void arm(const char* call, int which, int cause, const char* folder) {
    std::snprintf(fault.call.data(), fault.call.size(), "%s", call);
    std::snprintf(fault.folder.data(), fault.folder.size(), "%s", folder);
    fault.left = which - 1;
    fault.cause = cause;
    fault.failures = 0;
    fault.armed = true;
}

/// A program under LD_PRELOAD reads it when it starts.
struct FromEnvironment {
    FromEnvironment() {
        const char* words = std::getenv(carom::test::failingFilesVariable);
        std::array<char, 16> call{};
        std::array<char, PATH_MAX> folder{};
        int which = 0, cause = 0;
        if (words && std::sscanf(words, "%15s %d %d %4095s", call.data(), &which, &cause, folder.data()) == 4)
            arm(call.data(), which, cause, folder.data());
    }
} fromEnvironment;

bool isInFolder(const char* path) {
    return std::strncmp(path, fault.folder.data(), std::strlen(fault.folder.data())) == 0;
}

bool isInFolder(int descriptor) {
    std::array<char, 64> link{};
    std::array<char, PATH_MAX> path{};
    std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
    const ssize_t length = ::readlink(link.data(), path.data(), path.size() - 1);
    return length > 0 && isInFolder(path.data());
}

template<class File>
bool fails(const char* call, File file) {
    if (!fault.armed || std::strcmp(fault.call.data(), call) != 0) return false;
    const int before = errno;
    const bool ours = isInFolder(file);
    errno = before;
    if (!ours || fault.left.fetch_sub(1) > 0) return false;
    ++fault.failures;
    errno = fault.cause;
    return true;
}

template<class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

using Open = int (*)(const char*, int, ...);

int openNext(const char* name, const char* path, int flags, mode_t mode) {
    const bool toWrite = (flags & O_ACCMODE) != O_RDONLY;
    return toWrite && fails("open", path) ? -1 : next<Open>(name)(path, flags, mode);
}

} // namespace

namespace carom::test {

FailingFiles::FailingFiles(const char* call, int which, int cause, const char* folder) {
    arm(call, which, cause, folder);
}
FailingFiles::~FailingFiles() { fault.armed = false; }
int FailingFiles::failures() const { return fault.failures; }

} // namespace carom::test

extern "C" {

int open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    return openNext("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    return openNext("open64", path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
    static const auto inner = next<ssize_t (*)(int, const void*, size_t)>("write");
    if (!fails("write", descriptor)) return inner(descriptor, bytes, count);
    const bool takesAPart = fault.cause == ENOSPC && fault.failures == 1 && count > 1;
    return takesAPart ? inner(descriptor, bytes, count / 2) : -1;
}

int fsync(int descriptor) {
    static const auto inner = next<int (*)(int)>("fsync");
    return fails("fsync", descriptor) ? -1 : inner(descriptor);
}

int close(int descriptor) {
    static const auto inner = next<int (*)(int)>("close");
    if (!fails("close", descriptor)) return inner(descriptor);
    inner(descriptor); // as Linux does: the descriptor is gone whatever close says
    errno = fault.cause;
    return -1;
}

int rename(const char* from, const char* to) noexcept {
    static const auto inner = next<int (*)(const char*, const char*)>("rename");
    return fails("rename", to) ? -1 : inner(from, to);
}

int fchmod(int descriptor, mode_t mode) noexcept {
    static const auto inner = next<int (*)(int, mode_t)>("fchmod");
    return fails("fchmod", descriptor) ? -1 : inner(descriptor, mode);
}

} // extern "C"
