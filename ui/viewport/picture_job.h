// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"
#include "ui/viewport/lighting.h"
#include "ui/viewport/overlays.h"
#include "ui/viewport/room.h"

#include <QImage>
#include <QSize>

#include <memory>
#include <span>
#include <vector>

namespace carom {

/// A scene as the viewport shows it.
struct Stage {
    std::shared_ptr<const Pipeline> pipeline; ///< null: nothing but the sky
    std::vector<Pose> start;
    Room room;
};

/// A picture to be drawn, and all that takes: it may cross to another thread.
struct PictureJob {
    std::shared_ptr<const Stage> stage;                   ///< never null
    std::shared_ptr<const Snapshot> state;                ///< null: as at time 0
    std::shared_ptr<const std::vector<LineVertex>> lines; ///< never null
    PictureOptions options;

    std::span<const Pose> poses() const { return state ? std::span<const Pose>(state->pose) : stage->start; }
    QSize pixels() const {
        return {static_cast<int>(options.size.width), static_cast<int>(options.size.height)};
    }
};

struct DrawnPicture {
    PictureJob job;
    QImage image;            ///< null where OpenGL does not work or the size is too much for it
    double milliseconds = 0; ///< from the start of drawing until the image was there
};

} // namespace carom
