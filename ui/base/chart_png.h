// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QImage>

// PNG files of charts. Qt leaves it to libpng to choose a filter for each row, which tries all five: for
// photographs that makes small files. A chart is areas of one colour, which zlib alone makes as small, in a
// fifth of the time.

namespace carom {

/// The bytes of a PNG file with this picture, without its transparency; empty if it has no pixels.
QByteArray chartPng(const QImage& picture);

} // namespace carom
