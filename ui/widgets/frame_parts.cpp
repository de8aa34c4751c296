// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/frame_parts.h"

#include <QCoreApplication>

#include <algorithm>

namespace carom {

namespace {

/// What the step took outside its four measured stages. Clocks are read one after the other, so the stages
/// may add up to a hair more than the whole: never below zero.
double otherOf(const FrameSample& sample) {
    const FrameStatistics& frame = sample.statistics;
    return std::max(0.0,
                    frame.simulate - frame.integrate - frame.broadphase - frame.narrowphase - frame.respond);
}

} // namespace

const std::array<FramePart, framePartCount>& frameParts() {
    static const std::array<FramePart, framePartCount> parts = {{
        {QT_TRANSLATE_NOOP("FrameParts", "integrate"), QColor(0x56, 0xB4, 0xE9),
         [](const FrameSample& sample) { return sample.statistics.integrate; }},
        {QT_TRANSLATE_NOOP("FrameParts", "broad-phase"), QColor(0xE6, 0x9F, 0x00),
         [](const FrameSample& sample) { return sample.statistics.broadphase; }},
        {QT_TRANSLATE_NOOP("FrameParts", "narrow-phase"), QColor(0x00, 0x9E, 0x73),
         [](const FrameSample& sample) { return sample.statistics.narrowphase; }},
        {QT_TRANSLATE_NOOP("FrameParts", "respond"), QColor(0xD5, 0x5E, 0x00),
         [](const FrameSample& sample) { return sample.statistics.respond; }},
        {QT_TRANSLATE_NOOP("FrameParts", "other"), QColor(0x8C, 0x8C, 0x8C), otherOf},
        {QT_TRANSLATE_NOOP("FrameParts", "render"), QColor(0x8A, 0x6F, 0xD1),
         [](const FrameSample& sample) { return sample.render; }, true},
    }};
    return parts;
}

QString nameOf(const FramePart& part) { return QCoreApplication::translate("FrameParts", part.name); }

QString nameOfStep() { return QCoreApplication::translate("FrameParts", "step"); }

QString nameOfWhole() { return QCoreApplication::translate("FrameParts", "total"); }

double totalOf(const FrameSample& sample) {
    double total = 0;
    for (const FramePart& part : frameParts()) total += part.milliseconds(sample);
    return total;
}

} // namespace carom
