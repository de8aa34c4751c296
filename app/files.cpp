// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/files.h"

#include "app/errors.h"
#include "core/base/file_writer.h"
#include "core/language/analysis.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <vector>

namespace carom {
namespace {

struct Descriptor {
    explicit Descriptor(int opened) : number(opened) {}
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number;
};

/// Standard input and the pipes of a shell's `<(...)` have a writer; anything else is a mistake.
void refuseEndless(int descriptor, const std::string& path, const std::string& name) {
    struct stat found {};
    if (::fstat(descriptor, &found) != 0) throw UnreadableFile(name, errno);
    const bool isOpen =
        path == "-" || path.starts_with("/dev/fd/") || path.starts_with("/proc/") || path == "/dev/stdin";
    if (S_ISDIR(found.st_mode)) throw UnreadableFile(name, EISDIR);
    if (S_ISREG(found.st_mode) && found.st_size > static_cast<off_t>(largestText)) throw TextTooLarge(name);
    struct stat nothing {};
    const bool isNull = ::stat("/dev/null", &nothing) == 0 && nothing.st_rdev == found.st_rdev;
    if (S_ISCHR(found.st_mode) && ::isatty(descriptor) == 0 && !isNull)
        throw UnreadableFile("cannot read " + name + ": it is a device");
    if (S_ISBLK(found.st_mode)) throw UnreadableFile("cannot read " + name + ": it is a device");
    if (S_ISFIFO(found.st_mode) && !isOpen)
        throw UnreadableFile("cannot read " + name + ": it is a named pipe; give `-` to read standard input");
    // The writer of the pipe may be slow.
    const int flags = ::fcntl(descriptor, F_GETFL);
    if (flags >= 0 && (flags & O_NONBLOCK) != 0 && path != "-")
        ::fcntl(descriptor, F_SETFL, flags & ~O_NONBLOCK);
}

std::string nameOfOutput(const std::string& path) {
    return path == "-" ? "standard output" : "`" + path + "`";
}

FileError notWritten(const std::string& path, int cause) {
    return FileError("cannot write " + nameOfOutput(path) + ": " + whyNotWritten(path, cause), cause);
}

} // namespace

FileError::FileError(const std::string& what, const std::string& path, int cause)
    : std::runtime_error(what + " " + path + ": " + std::generic_category().message(cause)),
      m_isBrokenPipe(cause == EPIPE) {}

std::string readText(const std::string& path) {
    const bool fromInput = path == "-";
    const std::string name = fromInput ? "standard input" : "`" + path + "`";
    // Opening must not wait for the writer of a pipe.
    const Descriptor opened(fromInput ? -1 : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!fromInput && opened.number < 0) throw UnreadableFile(name, errno);
    const int descriptor = fromInput ? STDIN_FILENO : opened.number;
    refuseEndless(descriptor, path, name);
    std::string text;
    std::vector<char> block(1U << 16U);
    while (text.size() <= largestText) {
        const ssize_t count = ::read(descriptor, block.data(), block.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw UnreadableFile(name, errno);
        if (count == 0) return text;
        text.append(block.data(), static_cast<std::size_t>(count));
    }
    throw TextTooLarge(name);
}

TextTooLarge::TextTooLarge(const std::string& name)
    : std::runtime_error(name + " has more than " + std::to_string(largestText >> 20U) +
                         " MiB, which is the most that a scene's text may have") {}

std::string displayName(const std::string& path) { return path == "-" ? "<stdin>" : path; }

std::string titleOf(const std::string& path) { return std::filesystem::path(path).stem().string(); }

OutputFile::OutputFile(const std::string& path)
    : m_path(path),
      m_descriptor(path == "-" ? STDOUT_FILENO
                               : ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (m_descriptor < 0) fail();
}

OutputFile::~OutputFile() {
    try {
        flush();
    } catch (const FileError&) { // errors are reported by close()
    }
    if (m_descriptor > STDOUT_FILENO) ::close(m_descriptor);
}

void OutputFile::write(std::string_view text) {
    constexpr std::size_t most = 1U << 16U; // [bytes] that wait
    m_waiting += text;
    if (m_waiting.size() >= most) flush();
}

void OutputFile::flush() {
    const std::string text = std::move(m_waiting);
    m_waiting.clear(); // what cannot be written is not tried again
    send(text);
}

void OutputFile::send(std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(m_descriptor, text.data(), text.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail();
        text.remove_prefix(static_cast<std::size_t>(count));
    }
}

void OutputFile::close() {
    flush();
    const int descriptor = m_descriptor;
    m_descriptor = -1;
    if (descriptor != STDOUT_FILENO && ::close(descriptor) != 0) fail();
}

void OutputFile::fail() const { throw notWritten(m_path, errno); }

void refuseSharedFiles(const std::vector<NamedFile>& files) {
    namespace fs = std::filesystem;
    const auto canHold = [](const NamedFile& file) {
        std::error_code error;
        const fs::file_status status = fs::status(file.path, error);
        return !file.path.empty() && file.path != "-" && (!fs::exists(status) || fs::is_regular_file(status));
    };
    const auto areOne = [](const std::string& a, const std::string& b) {
        std::error_code error;
        if (fs::exists(a, error) && fs::exists(b, error))
            return fs::equivalent(a, b, error); // device and inode
        return fs::weakly_canonical(fs::absolute(a), error) == fs::weakly_canonical(fs::absolute(b), error);
    };
    for (std::size_t second = 1; second < files.size(); ++second)
        for (std::size_t first = 0; first < second; ++first)
            if (canHold(files[first]) && canHold(files[second]) &&
                areOne(files[first].path, files[second].path))
                throw UsageError(files[second].purpose + " would overwrite " + files[first].purpose + ": `" +
                                 files[second].path + "` is the same file");
}

void makeFolder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw FileError("cannot make the folder", path, error.value());
}

void writeFile(const std::string& folder, const std::string& name, std::string_view text) {
    replaceFile((std::filesystem::path(folder) / name).string(), text);
}

void InterimResults::write(const std::function<void()>& files) {
    try {
        files();
        m_failed = false;
    } catch (const FileError& error) {
        if (!std::exchange(m_failed, true)) printError(m_who + ": " + error.what() + "; the work goes on\n");
    }
}

void printOut(std::string_view text) {
    OutputFile output("-");
    output.write(text);
    output.close();
}

void printError(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void replaceFile(const std::string& path, std::string_view text) {
    FileWriter file(path);
    if (!file.write(text) || !file.commit()) throw notWritten(path, file.error());
}

} // namespace carom
