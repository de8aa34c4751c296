// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/clock.h"
#include "ui/viewport/picture_pace.h"

#include <QObject>
#include <QTimer>

#include <functional>

namespace carom {

/// When the next picture is drawn, and how well: one at a time, not before anything has changed, with pauses
/// where pictures are dear, and once nothing has changed for a moment again, smooth and with shadows. It
/// draws nothing itself.
///
///     changed ──▶ due() ──▶ begin ──▶ (somebody draws) ──▶ ended ──▶ due() if there was a change meanwhile
class PictureSchedule : public QObject {
    Q_OBJECT
  public:
    /// `isWanted` tells whether anybody would see a picture.
    explicit PictureSchedule(std::function<bool()> isWanted);

    /// Pictures can be drawn from now on; in software smooth ones cost twice as much, and are for scenes at
    /// rest.
    void setReady(bool software);
    /// What is drawn, or on screen, is no longer true.
    void changed();
    /// Another scene: nothing is known of what its pictures cost.
    void forgetCosts() { m_pace.forget(); }

    /// Whether a picture is to be drawn now. If so it is under way.
    bool begin();
    /// The one under way is there, after so long [ms], or is not: 0.
    void ended(double milliseconds);

    bool isSmooth() const { return !m_software || m_atRest; }
    /// Of the picture under way.
    bool hasShadows() const { return !m_hurried; }

  Q_SIGNALS:
    /// It is time to ask begin().
    void due();

  private:
    void schedule();

    std::function<bool()> m_isWanted;
    PicturePace m_pace;
    Stopwatch m_sincePicture;
    QTimer m_rest;
    QTimer m_pause;          ///< a picture is due when it ends
    bool m_ready = false;    ///< pictures can be drawn
    bool m_software = false; ///< by the processor
    bool m_underWay = false;
    bool m_stale = true;
    bool m_hurried = false;  ///< the picture under way has no shadows
    bool m_wasSmooth = true; ///< the picture under way
    bool m_atRest = false;   ///< nothing has changed for a moment: worth a smooth picture
};

} // namespace carom
