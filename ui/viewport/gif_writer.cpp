// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/gif_writer.h"

#include <QIODevice>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace carom {
namespace {

constexpr int codeBits = 8;     // of a pixel
constexpr int mostCodes = 4096; // of the dictionary: twelve bits

QByteArray word(int value) {
    return QByteArray(1, static_cast<char>(value & 0xff)) +
           QByteArray(1, static_cast<char>(value >> 8 & 0xff));
}

/// Packs codes of growing width, lowest bit first, into blocks of up to 255 bytes.
class CodeStream {
  public:
    void put(unsigned code, int width) {
        m_bits |= std::uint64_t{code} << m_count;
        for (m_count += width; m_count >= 8; m_count -= 8) {
            m_bytes += static_cast<char>(m_bits & 0xff);
            m_bits >>= 8;
        }
    }

    QByteArray blocks() {
        if (m_count > 0) m_bytes += static_cast<char>(m_bits & 0xff);
        QByteArray blocks;
        constexpr qsizetype longest = 255;
        for (qsizetype at = 0; at < m_bytes.size(); at += longest) {
            const QByteArray part = m_bytes.mid(at, longest);
            blocks += static_cast<char>(part.size());
            blocks += part;
        }
        return blocks + '\0';
    }

  private:
    QByteArray m_bytes;
    std::uint64_t m_bits = 0;
    int m_count = 0;
};

/// T. Welch, "A technique for high-performance data compression", Computer 17 (1984), as the format wants it:
/// the dictionary is a tree of codes, each with one child a pixel value.
QByteArray compressed(const QImage& picture) {
    constexpr unsigned clear = 1U << codeBits, end = clear + 1;
    std::vector<std::array<std::uint16_t, 1U << codeBits>> children(mostCodes);
    CodeStream stream;
    int width = codeBits + 1;
    unsigned next = end + 1;
    const auto restart = [&] {
        stream.put(clear, width);
        for (auto& child : children) child.fill(0);
        width = codeBits + 1;
        next = end + 1;
    };
    restart();
    int code = -1;
    for (int y = 0; y < picture.height(); ++y) {
        const uchar* row = picture.constScanLine(y);
        for (int x = 0; x < picture.width(); ++x) {
            const uchar pixel = row[x];
            if (code < 0) {
                code = pixel;
                continue;
            }
            std::uint16_t& child = children[static_cast<std::size_t>(code)][pixel];
            if (child != 0) {
                code = child;
                continue;
            }
            stream.put(static_cast<unsigned>(code), width);
            child = static_cast<std::uint16_t>(next);
            if (next >= 1U << width) ++width;
            if (++next == mostCodes) restart();
            code = pixel;
        }
    }
    if (code >= 0) stream.put(static_cast<unsigned>(code), width);
    stream.put(end, width);
    return QByteArray(1, char{codeBits}) + stream.blocks();
}

struct ColourCount {
    std::array<int, 3> channels{}; ///< 0..31
    int count = 0;
};

using Colours = std::vector<ColourCount>;

Colours histogramOf(const QImage& picture) {
    std::vector<int> counts(1U << 15U, 0);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const QRgb pixel = picture.pixel(x, y);
            ++counts[static_cast<std::size_t>(qRed(pixel) >> 3 << 10 | qGreen(pixel) >> 3 << 5 |
                                              qBlue(pixel) >> 3)];
        }
    Colours colours;
    for (int i = 0; i < static_cast<int>(counts.size()); ++i)
        if (counts[static_cast<std::size_t>(i)] > 0)
            colours.push_back({{i >> 10, i >> 5 & 31, i & 31}, counts[static_cast<std::size_t>(i)]});
    return colours;
}

/// The channel a set of colours spreads most in, and by how much.
std::pair<std::size_t, int> spreadOf(const Colours& colours) {
    std::pair<std::size_t, int> widest{0, 0};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto [low, high] = std::minmax_element(colours.begin(), colours.end(),
                                                     [channel](const ColourCount& a, const ColourCount& b) {
                                                         return a.channels[channel] < b.channels[channel];
                                                     });
        const int spread = high->channels[channel] - low->channels[channel];
        if (spread > widest.second) widest = {channel, spread};
    }
    return widest;
}

QRgb meanOf(const Colours& colours) {
    std::array<double, 3> sum{};
    double count = 0;
    for (const ColourCount& colour : colours) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            sum[channel] += static_cast<double>(colour.channels[channel]) * colour.count;
        count += colour.count;
    }
    const auto full = [&](std::size_t channel) {
        return static_cast<int>(sum[channel] / count * 255 / 31 + 0.5);
    };
    return qRgb(full(0), full(1), full(2));
}

} // namespace

QList<QRgb> bestColours(const QImage& picture, int count) {
    std::vector<Colours> sets = {histogramOf(picture)};
    while (static_cast<int>(sets.size()) < count) {
        const auto widest =
            std::max_element(sets.begin(), sets.end(), [](const Colours& a, const Colours& b) {
                return spreadOf(a).second < spreadOf(b).second;
            });
        const auto [channel, spread] = spreadOf(*widest);
        if (spread == 0) break;
        std::sort(widest->begin(), widest->end(),
                  [channel = channel](const ColourCount& a, const ColourCount& b) {
                      return a.channels[channel] < b.channels[channel];
                  });
        // Halves of equally many pixels; both keep a colour.
        int total = 0, seen = 0;
        for (const ColourCount& colour : *widest) total += colour.count;
        auto middle = widest->begin();
        while (middle + 1 != widest->end() && seen + middle->count <= total / 2) seen += (middle++)->count;
        if (middle == widest->begin()) ++middle;
        Colours upper(middle, widest->end());
        widest->erase(middle, widest->end());
        sets.push_back(std::move(upper));
    }
    QList<QRgb> colours;
    for (const Colours& set : sets) colours.append(meanOf(set));
    return colours;
}

GifWriter::GifWriter(QIODevice& device, const QSize& size, double rate)
    : m_device(device), m_size(size), m_rate(std::min(rate, double{highestRate})) {
    write(QByteArrayLiteral("GIF89a") + word(size.width()) + word(size.height()) + QByteArray("\x70\0\0", 3));
    write(QByteArrayLiteral("\x21\xff\x0bNETSCAPE2.0\x03\x01") + word(0) + '\0'); // repeats for ever
}

void GifWriter::add(const QImage& picture) {
    constexpr int colours = 1 << codeBits;
    QList<QRgb> table = bestColours(picture, colours);
    const QImage indexed =
        picture.convertToFormat(QImage::Format_Indexed8, table, Qt::DiffuseDither | Qt::AvoidDither);
    // From where this picture begins to where the next does, in whole hundredths each.
    const auto beginning = [this](int number) {
        return static_cast<int>(std::lround(100 * number / m_rate));
    };
    const int delay = beginning(m_pictures + 1) - beginning(m_pictures);
    ++m_pictures;
    write(QByteArray("\x21\xf9\x04\x04", 4) + word(delay) + QByteArray(2, '\0'));
    write(QByteArray(1, '\x2c') + word(0) + word(0) + word(m_size.width()) + word(m_size.height()) + '\x87');
    QByteArray palette;
    table.resize(colours);
    for (const QRgb colour : table) {
        palette += static_cast<char>(qRed(colour));
        palette += static_cast<char>(qGreen(colour));
        palette += static_cast<char>(qBlue(colour));
    }
    write(palette + compressed(indexed));
}

bool GifWriter::finish() {
    write(QByteArray(1, '\x3b'));
    return m_complete;
}

void GifWriter::write(const QByteArray& bytes) {
    m_complete = m_device.write(bytes) == bytes.size() && m_complete;
}

} // namespace carom
