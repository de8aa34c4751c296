// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace carom {

/// Numbers look alike in scenes, files, sentences, axes and fields, whatever the user's language: a point, no
/// separators of thousands. To be called when the application object is there, which takes over the user's
/// locale for both Qt and the C library. Dates keep the user's (QLocale::system()).
void writeNumbersAsScenesDo();

/// A number as one reads it aloud, rounded to so many significant digits and without an exponent: "17000",
/// "0.2".
QString rounded(double value, int digits);

/// A number in decimals without the zeros at its end: "0.2" for "0.200", "0" for "-0.00".
QString withoutLastZeros(QString number);

} // namespace carom
