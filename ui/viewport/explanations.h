// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"
#include "core/player/ghost.h"
#include "ui/viewport/camera.h"
#include "ui/viewport/overlays.h"

#include <deque>
#include <memory>
#include <vector>

class QPainter;

namespace carom {

/// What the viewport draws over the bodies, and what that needs besides the state on screen: the way they
/// came, the run before an edit, the broad-phase's cells.
class Explanations {
  public:
    /// Another scene: nothing of the old one is left.
    void clear();
    /// The state that is shown now; going back in time takes the trails back.
    void note(const Pipeline& pipeline, const Snapshot& snapshot);
    void setOverlays(Overlays overlays) { m_overlays = overlays; }
    void setStructure(std::vector<Aabb> boxes) { m_structure = std::move(boxes); }
    void setGhost(Ghost ghost) { m_ghost = std::move(ghost); }
    /// A second body that is outlined: what the selected one met.
    void setPartner(BodyIndex body) { m_partner = body; }
    /// How much longer arrows are than usual.
    void setArrows(double scale) { m_arrows = scale; }
    double arrows() const { return m_arrows; }

    Overlays overlays() const { return m_overlays; }
    /// Of the snapshot, or of the start where it is null.
    std::vector<LineVertex> lines(const Pipeline& pipeline, const Snapshot* snapshot) const;

  private:
    struct Passed {
        std::int64_t frame = 0;
        std::vector<Vec3> positions; ///< of the bodies with trails [m]
    };
    std::vector<std::vector<Vec3>> trails() const;

    Overlays m_overlays = 0;
    double m_arrows = 1;
    BodyIndex m_partner = noBody;
    std::vector<Aabb> m_structure;
    Ghost m_ghost;
    std::deque<Passed> m_passed; ///< ascending
};

/// Writes the labels of bodies over them.
void paintLabels(QPainter& painter, const Scene& scene, std::span<const Pose> poses, const Camera& camera,
                 const PictureSize& size, bool dark);

} // namespace carom
