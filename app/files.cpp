// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/files.h"

#include "app/errors.h"
#include "app/temporary_file.h"
#include "core/language/analysis.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

namespace carom {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string nameOfOutput(const std::string& path) {
    return path == "-" ? "standard output" : "`" + path + "`";
}

} // namespace

FileError::FileError(const std::string& what, const std::string& path, int cause)
    : std::runtime_error(what + " " + path + ": " + std::generic_category().message(cause)),
      m_isBrokenPipe(cause == EPIPE) {}

std::string readText(const std::string& path) {
    const bool fromInput = path == "-";
    const std::string name = fromInput ? "standard input" : "`" + path + "`";
    std::unique_ptr<std::FILE, CloseFile> opened;
    if (!fromInput) {
        opened.reset(std::fopen(path.c_str(), "rb"));
        if (!opened) throw UnreadableFile(name, errno);
    }
    std::FILE* file = fromInput ? stdin : opened.get();
    std::string text;
    std::vector<char> block(1U << 16U);
    while (text.size() <= largestText) {
        const std::size_t wanted = std::min(block.size(), largestText + 1 - text.size());
        const std::size_t count = std::fread(block.data(), 1, wanted, file);
        text.append(block.data(), count);
        if (count < wanted && std::ferror(file)) throw UnreadableFile(name, errno);
        if (count < wanted) break;
    }
    return text;
}

std::string displayName(const std::string& path) { return path == "-" ? "<stdin>" : path; }

OutputFile::OutputFile(const std::string& path)
    : m_path(path), m_file(path == "-" ? stdout : std::fopen(path.c_str(), "wb")) {
    if (!m_file) fail();
}

OutputFile::~OutputFile() {
    if (m_file && m_file != stdout) std::fclose(m_file);
}

void OutputFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), m_file) != text.size()) fail();
}

void OutputFile::close() {
    std::FILE* file = m_file;
    m_file = nullptr;
    if (std::fflush(file) != 0) fail();
    if (file != stdout && std::fclose(file) != 0) fail();
}

void OutputFile::fail() const { throw FileError("cannot write", nameOfOutput(m_path), errno); }

void makeFolder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw FileError("cannot make the folder", path, error.value());
}

void writeFile(const std::string& folder, const std::string& name, std::string_view text) {
    OutputFile file((std::filesystem::path(folder) / name).string());
    file.write(text);
    file.close();
}

void printOut(std::string_view text) {
    OutputFile output("-");
    output.write(text);
    output.close();
}

void printError(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void replaceFile(const std::string& path, std::string_view text) {
    const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr), &std::free);
    if (!real) throw FileError("cannot write", "`" + path + "`", errno);
    struct stat original {};
    if (::stat(real.get(), &original) != 0) throw FileError("cannot write", "`" + path + "`", errno);
    // Renaming asks for the directory's permission only; a file that may not be written is left alone.
    if (::access(real.get(), W_OK) != 0) throw FileError("cannot write", "`" + path + "`", errno);
    TemporaryFile temporary(real.get());
    temporary.write(text);
    temporary.takeOwnerOf(original);
    temporary.renameTo(real.get());
}

} // namespace carom
