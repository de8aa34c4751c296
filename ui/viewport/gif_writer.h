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
    /// The device must be open and stay so. `delay` of every picture in hundredths of a second; viewers show
    /// less than 2 as 10.
    GifWriter(QIODevice& device, const QSize& size, int delay);

    /// A picture of that size.
    void add(const QImage& picture);
    /// No picture comes any more. False if the device has not taken everything.
    bool finish();

  private:
    void write(const QByteArray& bytes);

    QIODevice& m_device;
    QSize m_size;
    int m_delay;
    bool m_complete = true;
};

/// Up to `count` colours that stand for those of a picture: P. Heckbert, "Color image quantization for frame
/// buffer display", SIGGRAPH 1982, median cut, on colours of five bits a channel.
QList<QRgb> bestColours(const QImage& picture, int count);

} // namespace carom
