// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/simulation/pipeline.h"

#include <memory>
#include <string>
#include <vector>

// Other engines behind two interfaces: one program runs a scene in any of them, and one loop measures all
// broad-phases.

namespace carom {

/// A scene in motion in some engine.
class PeerWorld {
  public:
    virtual ~PeerWorld() = default;
    PeerWorld() = default;
    PeerWorld(const PeerWorld&) = delete;
    PeerWorld& operator=(const PeerWorld&) = delete;

    virtual std::string name() const = 0;
    /// Where its rules are not ours, a sentence each.
    virtual std::vector<std::string> differences() const { return {}; }
    /// One frame of the scene's step, in as many steps as its settings say.
    virtual void step() = 0;
    /// Poses and velocities of all bodies, in our numbering.
    virtual void read(State& state) const = 0;
};

/// How an engine is used. Tuned is what an informed user would choose for these scenes: friction and
/// restitution combined as ours are, no threshold below which restitution ends, no damping, no sleeping; the
/// other way all is as the engine has it by itself.
struct PeerSettings {
    int substeps = 1; ///< steps a frame
    bool tuned = true;
    int iterations = 0; ///< 0: the engine's own
};
/// Each program has one of its own.
std::unique_ptr<PeerWorld> makePeerWorld(std::shared_ptr<const Pipeline> pipeline,
                                         const PeerSettings& settings);

/// Bullet's broad-phases as ours; what they report is what they keep as overlapping, which includes pairs
/// whose fattened or quantised boxes overlap, in an order of their own.
std::unique_ptr<Broadphase> makeBulletTree();
std::unique_ptr<Broadphase> makeBulletSweep();

} // namespace carom
