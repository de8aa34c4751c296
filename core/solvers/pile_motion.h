// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/contact_constraint.h"
#include "core/dynamics/state.h"
#include "core/math/types.h"

#include <span>
#include <vector>

// Moves a big pile of spheres through a substep in time proportional to its contacts, by sweeps of projected
// Gauss–Seidel (gauss_seidel.h has the equations and the sources). Spheres allow rows of 112 bytes and no
// frames: every arm is along the normal, a normal impulse turns nobody, and friction is a vector across it.
//
//     part      displacements that open the overlaps; velocities do not know of them
//     impacts   contacts that touch and close hard part with e times their closing speed
//     sweeps    v = v₀ + g h + M⁻¹ Jᵀ p, contact after contact made right, forces of the last substep to
//               start; from the top down and back up, as weight is handed on
//     settle    what moves within the tolerance is at rest, if all does
//     move      x += h (v₀ + v)/2, and h v for what an impact has struck, whose v₀ ended with it
//
// Many short substeps with few sweeps each, warm started, do better than few with many (M. Macklin et al.,
// "Small steps in physics simulation", 2019). The error that is left shows as overlap, which `part` takes
// back, and as a residual, which is reported. Deviations from the islands proper: impacts of a substep are
// solved for together with the forces, at its start, not one after the other and located. For stiff impacts
// (e near 1) that could gain energy, so they are left to the islands.

namespace carom {

struct PileInput {
    const Bodies& bodies;
    Vec3 gravity;         ///< [m/s²]
    double substep = 0;   ///< [s]
    double tolerance = 0; ///< a residual up to this is none [m/s]
    int sweeps = 0;       ///< at most
    State& state;
};

class PileMotion {
  public:
    /// Whether all of the island is round, does not roll with resistance, and hits softly.
    static bool treats(const Bodies& bodies, std::span<const BodyIndex> members, const ContactSet& contacts);

    /// Moves the members; separations and forces in `contacts` become those of the end. The last sweep's
    /// largest change [m/s].
    double advance(const PileInput& input, std::span<const BodyIndex> members, ContactSet& contacts);

    std::size_t impacts() const { return m_struck; }
    /// Whether overlaps were parted.
    bool parted() const { return m_parted; }

  private:
    struct Body {
        Vec3 velocity = Vec3::Zero();
        double inverseMass = 0;
        Vec3 spin = Vec3::Zero();
        double inverseInertia = 0;
    };
    struct Row {
        std::uint32_t a = 0, b = 0;            // of m_bodies; 0 is what cannot move
        double armA = 0, armB = 0;             // [m] along the normal
        Vec3 normal;                           // from A to B
        double bound = 0;                      // n·u >= −bound [m/s]
        double friction = 0;                   // μ
        double massNormal = 0, massAcross = 0; // [kg]
        double perMass = 0;                    // 1/massNormal [1/kg]
        double push = 0;                       // impulse along the normal [N s]
        Vec3 across = Vec3::Zero();            // impulse across it [N s]
    };
    void load(const PileInput& input, std::span<const BodyIndex> members, const ContactSet& contacts);
    void orderRows(const PileInput& input, const ContactSet& contacts);
    void part(const PileInput& input, std::span<const BodyIndex> members, ContactSet& contacts);
    void start(const PileInput& input, const ContactSet& contacts);
    double relax(Row& row);
    double relaxSmooth(Row& row);
    template<class Treat>
    void sweep(int number, const Treat& treat);
    void settle(double still);
    void move(const PileInput& input, std::span<const BodyIndex> members);
    void store(const PileInput& input, ContactSet& contacts) const;

    std::vector<std::uint32_t> m_local; // by body of the scene: its index in m_bodies
    std::vector<Body> m_bodies;
    std::vector<Vec3> m_before; // velocities at the start, by body of m_bodies
    std::vector<Vec3> m_spinBefore;
    std::vector<std::uint8_t> m_wasStruck; // by body of m_bodies
    std::vector<Vec3> m_shift;             // of parting, by body of m_bodies [m]
    std::vector<Row> m_rows;               // one a point, from the top down
    std::vector<std::uint32_t> m_place;    // by point: its row
    std::vector<double> m_depth;           // by point: how far down it is, times |g|
    std::vector<std::uint32_t> m_first;    // by layer: the next free row
    std::vector<std::uint8_t> m_hard;      // by row: it closes hard
    std::vector<double> m_gap, m_parting;  // by row [m], [kg m]
    std::size_t m_struck = 0;
    bool m_parted = false;
};

} // namespace carom
