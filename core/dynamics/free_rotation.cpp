// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/free_rotation.h"

#include "core/math/rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace carom {
namespace {

/// Moments that differ by less than this part of the largest count as equal: rounding in h² + 3 r² and the
/// like. The precession it neglects is 1e-14 of the spin; at a tenth, a cylinder of equal moments would be
/// moved by the splitting, which costs time only.
constexpr double equalMoments = 1e-14;

/// The largest angle of one composition [rad]. At 1/20 rad the sixth-order error is below 1e-13 a part. At
/// twice, it is up to 64 times as large; at half, a step takes twice as many parts.
constexpr double partAngle = 0.05;

/// Parts of a step at most. At 80 turns a step and more the orientation is less exact, and only the angular
/// momentum is kept to rounding; at half, at 40. Without a bound the largest finite speeds would take for
/// ever.
constexpr double mostParts = 10'000;

/// Yoshida's solution A: the middle one is 1 − 2 (sum of the others).
constexpr std::array<double, 3> yoshida = {-1.17767998417887, 0.235573213359357, 0.784513610477560};
constexpr double yoshidaMiddle = 1 - 2 * (yoshida[0] + yoshida[1] + yoshida[2]);

bool nearlyEqual(double a, double b) { return std::abs(a - b) <= equalMoments * std::max(a, b); }

/// The two axes that are not `axis`, ascending.
struct Others {
    Eigen::Index first, second;
};
Others othersThan(Eigen::Index axis) { return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2}; }

/// Sine and cosine of an angle [rad]. Most turns are small, and there the first terms of the series are exact
/// to rounding: what is left out is below 1e-19 of the sine and of 1. A call of the library takes longer than
/// all the rest of a turn.
struct SineCosine {
    double sine, cosine;

    explicit SineCosine(double angle) {
        constexpr double small = 1.0 / 16;
        if (!(std::abs(angle) <= small)) {
            sine = std::sin(angle);
            cosine = std::cos(angle);
            return;
        }
        const double x = angle * angle;
        sine = angle - angle * x * (1.0 / 6 - x * (1.0 / 120 - x * (1.0 / 5040 - x * (1.0 / 362'880))));
        cosine = 1 - x * (1.0 / 2 - x * (1.0 / 24 - x * (1.0 / 720 - x * (1.0 / 40'320))));
    }
};

/// An orientation that many small turns add up to, and what rounding has left out of it so far: 5e-17 a turn,
/// which in 2,000 turns a step would add up to 4e-16 of the energy, and always the same way where each were
/// normalised by itself (W. Kahan, "Further remarks on reducing truncation errors", 1965).
struct Turned {
    Quat orientation;
    Vec4 rest = Vec4::Zero();

    /// By `angle` [rad] about the body's own axis k; which one is known when this is compiled, so that
    /// nothing has to leave the registers.
    template<Eigen::Index k>
    void turn(double angle) {
        const auto [s, c] = SineCosine(0.25 * angle);
        const double sine = 2 * s * c, cosineLess1 = -2 * s * s; // of half the angle
        const Vec4 q = orientation.coeffs();
        constexpr Eigen::Index i = (k + 1) % 3, j = (k + 2) % 3;
        Vec4 change = cosineLess1 * q;
        change[k] += sine * q[3];
        change[3] -= sine * q[k];
        change[i] += sine * q[j];
        change[j] -= sine * q[i];
        change += rest;
        orientation.coeffs() += change;
        rest = change - (orientation.coeffs() - q);
    }

    /// Component k of a vector of the world along the body's own axes: of orientation.conjugate() * v, with
    /// the same operations.
    template<Eigen::Index k>
    double inBody(const Vec3& v) const {
        constexpr Eigen::Index i = (k + 1) % 3, j = (k + 2) % 3;
        const Vec3 inverse = -orientation.vec();
        const Vec3 twice = 2 * inverse.cross(v);
        return v[k] + orientation.w() * twice[k] + (inverse[i] * twice[j] - inverse[j] * twice[i]);
    }

    /// Through the rate c Lk for h seconds.
    template<Eigen::Index k>
    void spin(double c, const Vec3& momentum, double h) {
        turn<k>(h * c * inBody<k>(momentum));
    }
    void spin(Eigen::Index k, double c, const Vec3& momentum, double h) {
        if (k == 0) spin<0>(c, momentum, h);
        if (k == 1) spin<1>(c, momentum, h);
        if (k == 2) spin<2>(c, momentum, h);
    }
};

void rotateSymmetric(const Vec3& inertia, Eigen::Index axis, const Vec3& momentum, double h,
                     Quat& orientation) {
    const double across = inertia[othersThan(axis).first];
    Turned turned{orientation};
    turned.spin(axis, 1 / inertia[axis] - 1 / across, momentum, h);
    orientation = fromRotationVector((h / across) * momentum) * turned.orientation;
}

Eigen::Index middleOf(const Vec3& inertia) {
    Eigen::Index smallest = 0, largest = 0;
    inertia.minCoeff(&smallest);
    inertia.maxCoeff(&largest);
    return 3 - smallest - largest;
}

/// The pieces about the body's axes a and b alternate, symmetrically, through the given parts of h.
template<Eigen::Index a, Eigen::Index b>
void alternate(const Vec3& inertia, const Vec3& momentum, double h, std::span<const double> stages,
               Turned& turned) {
    constexpr Eigen::Index middle = 3 - a - b;
    const double first = 1 / inertia[a] - 1 / inertia[middle];
    const double second = 1 / inertia[b] - 1 / inertia[middle];
    double pending = 0; // neighbouring halves of A are one rotation
    for (const double stage : stages) {
        turned.spin<a>(first, momentum, (pending + 0.5 * stage) * h);
        turned.spin<b>(second, momentum, stage * h);
        pending = 0.5 * stage;
    }
    turned.spin<a>(first, momentum, pending * h);
}

/// Those about the two axes that have not the middle moment, ascending.
void rotateAsymmetric(const Vec3& inertia, const Vec3& momentum, double h, std::span<const double> stages,
                      Turned& turned) {
    const Eigen::Index middle = middleOf(inertia);
    if (middle == 0) alternate<1, 2>(inertia, momentum, h, stages, turned);
    if (middle == 1) alternate<0, 2>(inertia, momentum, h, stages, turned);
    if (middle == 2) alternate<0, 1>(inertia, momentum, h, stages, turned);
}

/// The piece about L, which commutes with the others.
void rotateAboutMomentum(const Vec3& inertia, const Vec3& momentum, double h, Quat& orientation) {
    orientation = fromRotationVector((h / inertia[middleOf(inertia)]) * momentum) * orientation;
}

/// Bodies with two or three equal moments, which have a closed form; false for the others.
bool rotateExactly(const Vec3& inertia, const Vec3& momentum, double h, Quat& orientation) {
    const bool xy = nearlyEqual(inertia.x(), inertia.y());
    const bool yz = nearlyEqual(inertia.y(), inertia.z());
    const bool zx = nearlyEqual(inertia.z(), inertia.x());
    if (xy && yz)
        orientation = fromRotationVector((h / inertia.x()) * momentum) * orientation;
    else if (xy || yz || zx)
        rotateSymmetric(inertia, xy ? 2 : yz ? 0 : 1, momentum, h, orientation);
    return xy || yz || zx;
}

/// Three different moments: `stages` through all of h, in parts that turn by no more than partAngle each.
void compose(const Vec3& inertia, const Vec3& momentum, double h, std::span<const double> stages,
             Quat& orientation) {
    const double parts = partsOfFreeRotation(inertia, momentum, h, orientation);
    Turned turned{orientation};
    for (double part = 0; part < parts; ++part)
        rotateAsymmetric(inertia, momentum, h / parts, stages, turned);
    orientation = turned.orientation;
    rotateAboutMomentum(inertia, momentum, h, orientation);
}

} // namespace

// With cs and cl the sizes of ck about the smallest and the largest moment the pieces turn by cs Ls and cl Ll
// a second, and change each other's rates at √(cs cl) |L|. Of Ls the most that it comes to is taken, at which
// Lm is 0:
//
//     max Ls² = Ls² + Lm² cl/(cs + cl)
//
// so that the number of parts is the same at both ends of a step, and a run is reversible.
double partsOfFreeRotation(const Vec3& inertia, const Vec3& angularMomentum, double h,
                           const Quat& orientation) {
    Eigen::Index smallest = 0, largest = 0;
    const double least = inertia.minCoeff(&smallest), most = inertia.maxCoeff(&largest);
    const Eigen::Index middle = middleOf(inertia);
    const double cs = 1 / least - 1 / inertia[middle], cl = 1 / inertia[middle] - 1 / most;
    const Vec3 inBody = orientation.conjugate() * angularMomentum;
    const double whole = angularMomentum.norm();
    const double mixed = cs + cl > 0 ? cl / (cs + cl) : 0;
    const double fastest = cs * std::hypot(inBody[smallest], std::sqrt(mixed) * inBody[middle]);
    const double rate = std::min(fastest + (std::sqrt(cs * cl) + cl) * whole, whole / least);
    return std::clamp(std::ceil(std::abs(h) * rate / partAngle), 1.0, mostParts);
}

void rotateFreely(const Vec3& inertia, const Vec3& angularMomentum, double h, Quat& orientation) {
    if (angularMomentum == Vec3::Zero()) return; // nothing to turn, and no rounding either
    if (!rotateExactly(inertia, angularMomentum, h, orientation)) {
        constexpr std::array<double, 7> sixthOrder = {yoshida[2], yoshida[1], yoshida[0], yoshidaMiddle,
                                                      yoshida[0], yoshida[1], yoshida[2]};
        compose(inertia, angularMomentum, h, sixthOrder, orientation);
    }
    orientation.normalize();
}

TwoRotations rotationsOf(const Vec3& inertia, const Vec3& angularMomentum, double h, Quat orientation) {
    if (hasEqualMoments(inertia)) return {angularMomentum / inertia.x(), Vec3::Zero()};
    rotateFreely(inertia, angularMomentum, 0.5 * h, orientation);
    const double middle = inertia[middleOf(inertia)];
    const Vec3 rates = (inertia.cwiseInverse().array() - 1 / middle).matrix();
    return {angularMomentum / middle, rates.cwiseProduct(orientation.conjugate() * angularMomentum)};
}

void rotateInParts(const Vec3& inertia, const Vec3& angularMomentum, double h, Quat& orientation) {
    if (angularMomentum == Vec3::Zero()) return;
    constexpr std::array<double, 1> whole = {1};
    if (!rotateExactly(inertia, angularMomentum, h, orientation))
        compose(inertia, angularMomentum, h, whole, orientation);
    orientation.normalize();
}

void rotateInPieces(const Vec3& inertia, const Vec3& angularMomentum, double h, int order,
                    Quat& orientation) {
    if (angularMomentum == Vec3::Zero()) return;
    if (!rotateExactly(inertia, angularMomentum, h, orientation)) {
        Turned turned{orientation};
        if (order == 1) {
            const Eigen::Index middle = middleOf(inertia);
            const Others k = othersThan(middle);
            for (const Eigen::Index axis : {k.first, k.second})
                turned.spin(axis, 1 / inertia[axis] - 1 / inertia[middle], angularMomentum, h);
        } else {
            constexpr std::array<double, 1> whole = {1};
            rotateAsymmetric(inertia, angularMomentum, h, whole, turned);
        }
        orientation = turned.orientation;
        rotateAboutMomentum(inertia, angularMomentum, h, orientation);
    }
    orientation.normalize();
}

Vec3 angularMomentumFrom(const Vec3& inertia, const Quat& orientation, const Vec3& angularVelocity) {
    return orientation * inertia.cwiseProduct(orientation.conjugate() * angularVelocity);
}

Vec3 angularVelocityFrom(const Vec3& inertia, const Quat& orientation, const Vec3& angularMomentum) {
    return orientation * (orientation.conjugate() * angularMomentum).cwiseQuotient(inertia);
}

Vec3 angularMomentumOf(const Bodies& bodies, BodyIndex body, const State& state) {
    const Vec3& inertia = bodies.inertia[body];
    const Vec3& spin = state.angularVelocity[body];
    if (isIsotropic(inertia)) return inertia.x() * spin;
    const Quat& orientation = state.pose[body].orientation;
    const Vec3& kept = state.angularMomentum[body];
    const bool holds = angularVelocityFrom(inertia, orientation, kept) == spin;
    return holds ? kept : angularMomentumFrom(inertia, orientation, spin);
}

bool hasEqualMoments(const Vec3& inertia) { return nearlyEqual(inertia.minCoeff(), inertia.maxCoeff()); }

void keepAngularMomentum(const Bodies& bodies, BodyIndex body, const Vec3& angularMomentum, State& state) {
    const Vec3& inertia = bodies.inertia[body];
    if (isIsotropic(inertia)) return;
    state.angularMomentum[body] = angularMomentum;
    state.angularVelocity[body] = angularVelocityFrom(inertia, state.pose[body].orientation, angularMomentum);
}

void rotateInPieces(const Bodies& bodies, std::span<const BodyIndex> list, double h, int order,
                    State& state) {
    for (const BodyIndex i : list) {
        const Vec3 momentum = angularMomentumOf(bodies, i, state);
        rotateInPieces(bodies.inertia[i], momentum, h, order, state.pose[i].orientation);
        keepAngularMomentum(bodies, i, momentum, state);
    }
}

void rotateAllFreely(const Bodies& bodies, std::span<const BodyIndex> list, double h, State& state) {
    for (const BodyIndex i : list) {
        if (state.angularVelocity[i] == Vec3::Zero()) continue;
        const Vec3 momentum = angularMomentumOf(bodies, i, state);
        rotateBetween(bodies, i, momentum, momentum, h, state);
    }
}

void rotateBetween(const Bodies& bodies, BodyIndex body, const Vec3& before, const Vec3& after, double h,
                   State& state) {
    if (before == Vec3::Zero() && after == Vec3::Zero()) return;
    rotateFreely(bodies.inertia[body], 0.5 * (before + after), h, state.pose[body].orientation);
    keepAngularMomentum(bodies, body, after, state);
}

} // namespace carom
