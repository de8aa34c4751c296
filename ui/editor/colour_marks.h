// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/live_build.h"

#include <QColor>

namespace carom {

class SceneEditor;

/// Of colour_marks.cpp, for those who look at the text.
inline constexpr int colourIndicator = 15; // below it are those of diagnostics, snippets and the find bar

/// Of the indicator's value at a place where it is not 0.
QColor colourOf(long indicatorValue);

/// Underlines every colour in the text with itself; of a text of very many bodies the first ten thousand.
void markColours(SceneEditor& editor, const BuildResult& result);

} // namespace carom
