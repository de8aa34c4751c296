// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/math/pose.h"
#include "core/math/types.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace carom {

class World;

enum class BreakKind : std::uint8_t { Contact, Penetration, EnergyDrift, Speed, PlaneCrossed };

/// What a kind needs, for dialogs and messages.
struct BreakKindRow {
    BreakKind kind;
    std::string_view name;  ///< "contact"
    std::string_view limit; ///< what `limit` is, with its unit; empty where there is none
    int bodies = 0;         ///< how many bodies it names
};
std::span<const BreakKindRow> breakKinds();

/// Something that may happen between two frames, at which a run stops.
struct Breakpoint {
    BreakKind kind = BreakKind::Contact;
    BodyIndex a = noBody, b = noBody; ///< noBody: any
    double limit = 0; ///< depth [m], drift (relative), speed [m/s], or the plane's place on its axis [m]
    int axis = 1;     ///< of the plane: 0 x, 1 y, 2 z
};

/// Finds the frames of a run at which a condition begins to hold. It depends on a frame and the one before it
/// only, so the result is the same in whichever order frames are checked.
class BreakWatch {
  public:
    BreakWatch() = default;
    explicit BreakWatch(std::vector<Breakpoint> breakpoints) : m_breakpoints(std::move(breakpoints)) {}

    bool empty() const { return m_breakpoints.empty(); }
    /// The world's state is the frame before the next.
    void begin(const World& world);
    /// After one step: the first breakpoint that began to hold in it.
    std::optional<std::size_t> check(const World& world);

  private:
    bool holds(const Breakpoint& breakpoint, const World& world) const;
    bool happened(const Breakpoint& breakpoint, const World& world) const;
    bool met(const World& world, BodyIndex a, BodyIndex b) const;
    bool wereStruck(const Breakpoint& breakpoint, const World& world) const;

    std::vector<Breakpoint> m_breakpoints;
    std::vector<bool> m_held; ///< by breakpoint, in the frame before
    std::vector<Pose> m_poseBefore;
    std::vector<Vec3> m_velocityBefore;
};

} // namespace carom
