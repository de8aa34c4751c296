// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/chart_png.h"

#include <QtEndian>

#include <array>
#include <cstdint>
#include <cstring>

// Portable Network Graphics (PNG) Specification, second edition (2003): a signature, then chunks, each its
// length, its name of four letters, its content, and a cyclic redundancy check of name and content.

namespace carom {
namespace {

/// zlib's level: at 9 twice the time for files a twentieth smaller, at 1 files twice as large.
constexpr int level = 6;
constexpr qsizetype lengthOfQt = 4; ///< [bytes] that qCompress() puts before what zlib makes

constexpr std::array<std::uint32_t, 256> checkTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
        std::uint32_t check = byte;
        for (int bit = 0; bit < 8; ++bit) check = check & 1 ? 0xEDB88320U ^ check >> 1 : check >> 1;
        table[byte] = check;
    }
    return table;
}();

std::uint32_t checkOf(QByteArrayView bytes) {
    std::uint32_t check = ~0U;
    for (const char byte : bytes)
        check = checkTable[(check ^ static_cast<std::uint8_t>(byte)) & 0xFF] ^ check >> 8;
    return ~check;
}

void appendNumber(QByteArray& bytes, std::uint32_t number) {
    const std::uint32_t bigEndian = qToBigEndian(number);
    bytes.append(reinterpret_cast<const char*>(&bigEndian), sizeof bigEndian);
}

void appendChunk(QByteArray& file, const char* name, QByteArrayView content) {
    appendNumber(file, static_cast<std::uint32_t>(content.size()));
    const QByteArray checked = name + content.toByteArray();
    file += checked;
    appendNumber(file, checkOf(checked));
}

/// Each row: 0 for no filter, then red, green and blue of its pixels.
QByteArray rowsOf(const QImage& picture) {
    const qsizetype width = 3 * qsizetype{picture.width()};
    QByteArray rows(picture.height() * (1 + width), '\0');
    for (int y = 0; y < picture.height(); ++y)
        std::memcpy(rows.data() + y * (1 + width) + 1, picture.constScanLine(y),
                    static_cast<std::size_t>(width));
    return rows;
}

} // namespace

QByteArray chartPng(const QImage& picture) {
    if (picture.isNull()) return {};
    const QImage colours = picture.convertToFormat(QImage::Format_RGB888);
    QByteArray header, density;
    appendNumber(header, static_cast<std::uint32_t>(colours.width()));
    appendNumber(header, static_cast<std::uint32_t>(colours.height()));
    header.append("\x08\x02\0\0\0", 5); // 8 bits a colour, three colours; deflate, no interlace
    appendNumber(density, static_cast<std::uint32_t>(picture.dotsPerMeterX()));
    appendNumber(density, static_cast<std::uint32_t>(picture.dotsPerMeterY()));
    density.append('\x01'); // a metre
    QByteArray file("\x89PNG\r\n\x1A\n");
    appendChunk(file, "IHDR", header);
    appendChunk(file, "pHYs", density);
    appendChunk(file, "IDAT", QByteArrayView(qCompress(rowsOf(colours), level)).sliced(lengthOfQt));
    appendChunk(file, "IEND", {});
    return file;
}

} // namespace carom
