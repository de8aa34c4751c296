// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom {

/// Numbers look alike in scenes, files, sentences, axes and fields, whatever the user's language: a point, no
/// separators of thousands. To be called when the application object is there, which takes over the user's
/// locale for both Qt and the C library. Dates keep the user's (QLocale::system()).
void writeNumbersAsScenesDo();

} // namespace carom
