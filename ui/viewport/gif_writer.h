// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QImage>
#include <QSize>

class QIODevice;

namespace carom {

/// Writes an animation that every browser shows: CompuServe, "Graphics Interchange Format, Version 89a",
/// 1990. Each picture has the 256 colours that suit it best; it repeats for ever.
class GifWriter {
  public:
    /// [1/s]; viewers show pictures of less than two hundredths of a second for ten hundredths: at twice this
    /// rate a video would be five times too slow.
    static constexpr int highestRate = 50;

    /// The device must be open and stay so. Pictures stand for whole hundredths of a second, which take turns
    /// so that the animation keeps its `rate` [1/s].
    GifWriter(QIODevice& device, const QSize& size, double rate);

    /// A picture of that size.
    void add(const QImage& picture);
    /// No picture comes any more. False if the device has not taken everything.
    bool finish();

  private:
    void write(const QByteArray& bytes);

    QIODevice& m_device;
    QSize m_size;
    double m_rate;      ///< pictures a second
    int m_pictures = 0; ///< written
    bool m_complete = true;
};

/// Up to `count` colours that stand for those of a picture: P. Heckbert, "Color image quantization for frame
/// buffer display", SIGGRAPH 1982, median cut, on colours of five bits a channel.
QList<QRgb> bestColours(const QImage& picture, int count);

} // namespace carom
