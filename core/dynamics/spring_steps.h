// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/wide.h"
#include "core/dynamics/spring_network.h"

#include <array>
#include <cstddef>
#include <vector>

// A step h of bodies on springs that touch nothing, to order four or six. The rule of order two is that of R.
// LaBudde, D. Greenspan, "Energy and momentum conserving methods of arbitrary order for the numerical
// integration of equations of motion", Numerische Mathematik 25, 1975: over a part T the impulse of a spring
// has the direction of its mean vector and follows from its mean length and the change of its length,
//
//     p = −T (k (l̄ − L) + c (l₁ − l₀)/T) x̄/l̄      x̄ = (x₀ + x₁)/2,  l̄ = (l₀ + l₁)/2,  l = |x|
//
// It is symmetric and keeps the energy of undamped springs between centres to rounding, whatever T is and
// whichever sign it has; so does any sequence of it. Five parts bᵢ h that lead to order four:
//
//     b = 1/(4 − 4^⅓) four times, in their middle 1 − 4b < 0        Σ bᵢ = 1, Σ bᵢ³ = 0
//
// (M. Suzuki, "Fractal decomposition of exponential operators with applications to many-body theories and
// Monte Carlo simulations", Physics Letters A 146, 1990). The phase of an oscillation is off by Σ bᵢ⁵
// (ωh)⁴/80 = 9.3e-4 (ωh)⁴ of it; no sequence of five has a smaller sum. Bodies stay within the time of the
// step: the parts end at 0.41, 0.83, 0.17, 0.59 and 1 of it. Nine parts lead to order six (W. Kahan, R.-C.
// Li, "Composition constants for raising the orders of unconventional schemes for ordinary differential
// equations", Mathematics of Computation 66, 1997).
//
// A part that runs backwards adds the energy that a damper takes, and needs the damping resolved: it would
// have no solution where the rate λ at which velocities decay is 2/(h |1 − 4b|). Beyond λ h = 1.6 as many
// equal parts are taken, of order two: there both have the same error in what decays so fast.
//
// Where a body with a spring attached off its centre turns far within a step, or oscillates about the
// attachment, the step is divided: over a large turn the mean of a lever arm is shorter than the arm.
//
// The equations are solved by iteration. An impulse p changes the length from which it is computed: along a
// spring between masses m and m' this reduces p by κ = (T² k/4 + T c/2)(1/m + 1/m') times itself. So each
// iteration applies 1/(1 + κ) of the residual along the spring: for one spring that is Newton's method except
// for rotation, and for several the error decreases by the factor κ/(1 + κ) at least, at any stiffness.

namespace carom {

class SpringSteps {
  public:
    /// Computes the step of the network. False where the iteration does not converge: a spring is too stiff
    /// for the step.
    bool find(const SpringNetwork& network, double h, int order, const State& state);
    /// Applies it to the state.
    void apply(const SpringNetwork& network, double h, State& state) const;

    /// Where the body at this place in `moving` ends [m].
    const Vec3& placeAfter(std::size_t place) const { return m_moving[place].x1; }
    /// Evaluations of springs in the last step, whether it converged or not.
    std::size_t looks() const { return m_looks; }
    /// The number of times in the last step at which velocities are known: its start, and the end of every
    /// part.
    std::size_t times() const { return m_times; }
    /// Of a body then, by its place in `moving` [m/s].
    const Vec3& velocity(std::size_t place, std::size_t time) const {
        return m_velocities[time * m_moving.size() + place];
    }

  private:
    struct Moving {
        double inverseMass = 0;
        double damping = 0; ///< rate at which all its dampers together slow it [1/s]
        bool turns = false; ///< a spring is attached off its centre
        Vec3 x0, v0, x1, v1, L0, L1;
        Quat q0, q1;
        Vec3 impulse, torque; ///< [N s], [N m s], of this round
    };
    struct End {
        int body = -1;                 ///< place in `moving`, or none
        Vec3 at = Vec3::Zero();        ///< in the body, or in the world
        bool isCentre = false;         ///< of the body
        Vec3 before = Vec3::Zero();    ///< place at the start of the part [m]
        Vec3 armBefore = Vec3::Zero(); ///< from the centre [m]
        Vec3 armAfter = Vec3::Zero();  ///< at the end of the part so far [m]
    };
    struct Link {
        End from, to;
        double stiffness, damping, length;
        double yield = 0;         ///< 1/m + 1/m' [1/kg]
        double before = 0;        ///< length at the start of the part [m]
        Vec3 span = Vec3::Zero(); ///< from end to end, at the start of the part [m]
        double pull = 0;          ///< k T, in the part [N s/m]
        double share = 0;         ///< of an impulse along the spring that its own effect takes away
        Vec3 push = Vec3::Zero(); ///< p, so far [N s]
    };

    /// Four springs one behind the other, each a lane.
    struct alignas(32) Four {
        std::array<Wide, 3> last{}, span{}, push{}; ///< by axis; last: as span, at the end of the part so far
        Wide pull{}, share{}, damping{}, length{}, before{};
    };

    void load(const SpringNetwork& network, const State& state);
    End endOf(const SpringNetwork& network, const State& state, BodyIndex body, const Vec3& at);
    bool followPart(const SpringNetwork& network, double T, double guess);
    void pull();
    void loadFours();
    static void findImpulses(Four& four);
    Vec3 placeOf(End& end) const;
    void push(const End& end, const Vec3& impulse);
    double advance(const SpringNetwork& network, double T);
    void beginLinks(double T, double guess);
    double fastestDamping() const;
    int cutsFor(const SpringNetwork& network, double h, const State& state) const;
    double squaredSpeed(const SpringNetwork& network, std::size_t place, const Vec3& momentum) const;
    bool follow(const SpringNetwork& network, double h, int order, const State& state, int cuts);
    void noteVelocities();

    std::vector<int> m_place; // by body of the scene
    std::vector<Moving> m_moving;
    std::vector<Link> m_links;
    std::vector<Four> m_fours;      // of m_links, where none of four turns a body
    std::vector<Vec3> m_velocities; // by time, then by place [m/s]
    std::size_t m_times = 0;
    double m_rounding = 0; // of the lengths of springs, as it shows in velocities in the part [m/s]
    std::size_t m_looks = 0;
};

} // namespace carom
