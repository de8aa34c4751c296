// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/colour_marks.h"

#include "ui/editor/scene_editor.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

using ColourSci = QsciScintillaBase;

/// Colours that are marked at most; ten times as many take ten times the time at every change.
constexpr std::size_t mostColours = 10'000;
constexpr int valueIsColour = 1; // SC_INDICFLAG_VALUEFORE, which QScintilla does not name

/// As Scintilla has it: blue, green, red from above.
int packed(const Vec3& colour) {
    const auto part = [&](int i) {
        return static_cast<int>(std::lround(255 * std::clamp(colour[i], 0.0, 1.0)));
    };
    return part(0) | part(1) << 8 | part(2) << 16;
}

} // namespace

QColor colourOf(long indicatorValue) {
    return QColor(static_cast<int>(indicatorValue & 0xff), static_cast<int>(indicatorValue >> 8 & 0xff),
                  static_cast<int>(indicatorValue >> 16 & 0xff));
}

void markColours(SceneEditor& editor, const BuildResult& result) {
    editor.send(ColourSci::SCI_INDICSETSTYLE, colourIndicator, ColourSci::INDIC_COMPOSITIONTHICK);
    editor.send(ColourSci::SCI_INDICSETFLAGS, colourIndicator, valueIsColour);
    editor.send(ColourSci::SCI_SETINDICATORCURRENT, colourIndicator);
    editor.send(ColourSci::SCI_INDICATORCLEARRANGE, 0, editor.send(ColourSci::SCI_GETLENGTH));
    const Scene& scene = result.scene();
    std::size_t marked = 0;
    for (const Body& body : scene.bodies) {
        const ParameterSource* given = scene.find(body.source, "colour");
        if (given == nullptr) continue;
        editor.send(ColourSci::SCI_SETINDICATORVALUE, packed(body.colour) | ColourSci::SC_INDICVALUEBIT);
        editor.send(ColourSci::SCI_INDICATORFILLRANGE, given->value.offset, given->value.length);
        if (++marked == mostColours) break;
    }
}

} // namespace carom
