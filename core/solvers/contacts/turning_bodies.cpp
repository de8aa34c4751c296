// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/turning_bodies.h"

#include "core/base/wide.h"
#include "core/dynamics/free_rotation.h"
#include "core/solvers/contacts/wide_bodies.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <variant>

namespace carom {
namespace {

/// Bodies that one thread turns at least.
constexpr std::size_t fewTurning = Workers::enoughOf(30);

/// Contacts of a body are found anew within a look when its rotation may have moved a point of its surface
/// off the line that the rows foresee by this part of its half thickness, r φ²/2 for a rotation of φ. At
/// half, coins that spin fast sink in by three fifths of what they do, at twice by a third more; 2 % more or
/// fewer contacts are found. Where a cap lies on a face, the rim between two of its four points comes down by
/// (1 − 1/√2) r φ.
constexpr double turnedError = 0.0025, betweenPoints = 1 - 0.5 * std::numbers::sqrt2;
/// The point at which a rim or a side touches moves on as a cylinder turns, so it is found anew at this part
/// of that. At half, heaps of cylinders overlap by a tenth less at most and cost 5 % more, at twice by half
/// as much again; where it is 1, by two and a half times as much.
constexpr double rolledPart = 1.0 / 8;

} // namespace

Turnable turnableOf(const Shape& shape, double radius) {
    constexpr double any = std::numeric_limits<double>::infinity();
    if (std::holds_alternative<Sphere>(shape)) return {any, any, any, false};
    const double most = turnedError * halfThicknessOf(shape), far = 2 * most / radius;
    const Cylinder* const cylinder = std::get_if<Cylinder>(&shape);
    if (cylinder == nullptr) return {far, far, far, false};
    const double rolled = rolledPart * far;
    const double onCap = most / (betweenPoints * cylinder->radius);
    return {rolled, rolled, std::min(rolled, onCap * onCap), true};
}

void TurningBodies::add(const Bodies& bodies, BodyIndex body, const State& state) {
    /// The largest angle of one composition of free_rotation.h where the moments differ [rad]; its error is
    /// of order six there. At twice, the error of a step is 64 times as large; at half, more bodies are
    /// turned one by one.
    constexpr double onePart = 0.05;
    Record& record = m_records.emplace_back();
    const Vec3& inertia = bodies.inertia[body];
    setOrientation(m_records.size() - 1, state.pose[body].orientation);
    record.momentum = arrayOf(angularMomentumOf(bodies, body, state));
    record.spin = arrayOf(state.angularVelocity[body]);
    record.inertia = arrayOf(inertia);
    record.inverse = arrayOf(bodies.inverseInertia[body]);
    Eigen::Index least = 0, largest = 0;
    inertia.minCoeff(&least);
    inertia.maxCoeff(&largest);
    record.isRound = isIsotropic(inertia) ? 1 : 0;
    const Eigen::Index middle = least == largest ? 0 : 3 - least - largest;
    const std::size_t first = middle == 0 ? 1 : 0, second = middle == 2 ? 1 : 2;
    record.aboutMomentum = 1 / inertia[middle];
    record.first[first] = record.second[second] = 1;
    record.aboutFirst = 1 / record.inertia[first] - record.aboutMomentum;
    record.aboutSecond = 1 / record.inertia[second] - record.aboutMomentum;
    record.unevenness = inertia[largest] / inertia[least] - 1;
    const bool isExact = record.aboutFirst == 0 || record.aboutSecond == 0;
    const double most = (isExact ? mostAngle : onePart) * inertia[least];
    record.most = most * most;
}

/// Turns four bodies at a time, one in each lane. Inlined into its caller, like all wide functions.
struct TurningKernel {
    using Record = TurningBodies::Record;
    using Four = std::array<std::uint32_t, 4>;
    static constexpr std::size_t stride = strideOf<Record>;

    /// An orientation.
    struct Turned {
        Wide x, y, z, w;
    };
    /// Columns of its matrix.
    struct Axes {
        Wide3 x, y, z;
        CAROM_INLINE Wide3 inBody(const Wide3& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
        CAROM_INLINE Wide3 inWorld(const Wide3& v) const { return v.x * x + v.y * y + v.z * z; }
    };
    CAROM_INLINE static Axes axesOf(const Turned& q) {
        const Wide one = wideOf(1), two = wideOf(2);
        const Wide x = two * q.x, y = two * q.y, z = two * q.z;
        const Wide wx = x * q.w, wy = y * q.w, wz = z * q.w;
        const Wide xx = x * q.x, xy = y * q.x, xz = z * q.x, yy = y * q.y, yz = z * q.y, zz = z * q.z;
        return {{one - (yy + zz), xy + wz, xz - wy},
                {xy - wz, one - (xx + zz), yz + wx},
                {xz + wy, yz - wx, one - (xx + yy)}};
    }
    CAROM_INLINE static Turned product(const Turned& p, const Turned& q) {
        return {p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y, p.w * q.y + p.y * q.w + p.z * q.x - p.x * q.z,
                p.w * q.z + p.z * q.w + p.x * q.y - p.y * q.x, p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z};
    }
    /// Turns by a rotation vector [rad] that is at most mostAngle long, with series for sin x / x and cos x
    /// of half of it.
    CAROM_INLINE static Turned turnBy(const Wide3& angle) {
        const Wide one = wideOf(1), square = wideOf(0.25) * dot(angle, angle);
        const Wide sine = one - square / wideOf(6) *
                                    (one - square / wideOf(20) *
                                               (one - square / wideOf(42) * (one - square / wideOf(72)))),
                   cosine = one - square / wideOf(2) *
                                      (one - square / wideOf(12) *
                                                 (one - square / wideOf(30) * (one - square / wideOf(56))));
        const Wide3 half = (wideOf(0.5) * sine) * angle;
        return {half.x, half.y, half.z, cosine};
    }
    /// Turns about an axis of the body by the angle c h times the angular momentum about it.
    CAROM_INLINE static Turned turnedAbout(const Turned& q, const Wide3& axis, const Wide& ch,
                                           const Wide3& momentum) {
        return product(q, turnBy((ch * dot(axis, axesOf(q).inBody(momentum))) * axis));
    }

    /// Lanes that turn too far are left unchanged; they are not 0 in the result.
    CAROM_INLINE static Wide turn(Record* records, const Four& four, double duration, SolverBody* solved) {
        const double* record = records->orientation.data();
        const Wide h = wideOf(duration), half = wideOf(0.5 * duration), one = wideOf(1), zero{};
        Turned q;
        gatherFour(record, stride, four, q.x, q.y, q.z, q.w);
        Wide3 kept, spinThen, inertia, inverse, first, second;
        Wide most, isRound, aboutMomentum, unused, aboutFirst, aboutSecond;
        gatherFour(record + 4, stride, four, kept.x, kept.y, kept.z, most);
        gatherFour(record + 8, stride, four, spinThen.x, spinThen.y, spinThen.z, isRound);
        gatherFour(record + 12, stride, four, inertia.x, inertia.y, inertia.z, aboutMomentum);
        gatherFour(record + 16, stride, four, inverse.x, inverse.y, inverse.z, unused);
        gatherFour(record + 20, stride, four, first.x, first.y, first.z, aboutFirst);
        gatherFour(record + 24, stride, four, second.x, second.y, second.z, aboutSecond);
        Motion body;
        gather(solved, four, body);

        const Axes before = axesOf(q);
        const Wide3 inBody = before.inBody(body.spin);
        const Wide3 fresh =
            before.inWorld({inBody.x * inertia.x, inBody.y * inertia.y, inBody.z * inertia.z});
        const auto isKept =
            (spinThen.x == body.spin.x) & (spinThen.y == body.spin.y) & (spinThen.z == body.spin.z);
        const Wide3 momentum{isKept ? kept.x : fresh.x, isKept ? kept.y : fresh.y, isKept ? kept.z : fresh.z};
        const auto isFar = !(h * h * dot(momentum, momentum) <= most);

        Turned turned = q;
        const bool isMixed = anyLane(aboutFirst);
        if (isMixed) turned = turnedAbout(turned, first, half * aboutFirst, momentum);
        if (anyLane(aboutSecond)) turned = turnedAbout(turned, second, h * aboutSecond, momentum);
        if (isMixed) turned = turnedAbout(turned, first, half * aboutFirst, momentum);
        turned = product(turnBy((h * aboutMomentum) * momentum), turned);
        const Wide square =
            turned.x * turned.x + turned.y * turned.y + turned.z * turned.z + turned.w * turned.w;
        const Wide unit = wideOf(1.5) - wideOf(0.5) * square; // 1/√square, which is 1 but for rounding

        const Axes after = axesOf({unit * turned.x, unit * turned.y, unit * turned.z, unit * turned.w});
        const Wide3 now = after.inBody(momentum);
        const Wide3 spin = after.inWorld({now.x / inertia.x, now.y / inertia.y, now.z / inertia.z});
        const auto staysRound = (isRound != zero) | isFar;
        const auto chosen = [](const auto& mask, const Wide& ifSo, const Wide& otherwise) {
            return mask ? ifSo : otherwise;
        };
        Wide a = chosen(isFar, q.x, unit * turned.x), b = chosen(isFar, q.y, unit * turned.y),
             c = chosen(isFar, q.z, unit * turned.z), d = chosen(isFar, q.w, unit * turned.w);
        scatterFour(records->orientation.data(), four, a, b, c, d);
        scatterFour(records->orientation.data() + 4, four, momentum.x, momentum.y, momentum.z, most);
        const Wide3 spinNow{chosen(staysRound, body.spin.x, spin.x), chosen(staysRound, body.spin.y, spin.y),
                            chosen(staysRound, body.spin.z, spin.z)};
        scatterFour(records->orientation.data() + 8, four, spinNow.x, spinNow.y, spinNow.z, isRound);

        const Wide3 x = inverse.x * after.x, y = inverse.y * after.y, z = inverse.z * after.z;
        const auto entry = [&](const Wide& ax, const Wide& ay, const Wide& az, const Wide& bx, const Wide& by,
                               const Wide& bz, const Wide& old) {
            return chosen(staysRound, old, ax * bx + ay * by + az * bz);
        };
        scatterBody(solved, four, 4, spinNow.x, spinNow.y, spinNow.z, body.roundInverse);
        scatterBody(solved, four, 8, entry(x.x, y.x, z.x, after.x.x, after.y.x, after.z.x, body.xx),
                    entry(x.x, y.x, z.x, after.x.y, after.y.y, after.z.y, body.xy),
                    entry(x.x, y.x, z.x, after.x.z, after.y.z, after.z.z, body.xz),
                    entry(x.y, y.y, z.y, after.x.y, after.y.y, after.z.y, body.yy));
        scatterBody(solved, four, 12, entry(x.y, y.y, z.y, after.x.z, after.y.z, after.z.z, body.yz),
                    entry(x.z, y.z, z.z, after.x.z, after.y.z, after.z.z, body.zz), zero, zero);
        return isFar ? one : zero;
    }

    CAROM_INLINE static void scatterFour(double* first, const Four& four, Wide a, Wide b, Wide c, Wide d) {
        transpose(a, b, c, d);
        storeWide(first + stride * four[0], a);
        storeWide(first + stride * four[1], b);
        storeWide(first + stride * four[2], c);
        storeWide(first + stride * four[3], d);
    }
    CAROM_INLINE static void scatterBody(SolverBody* bodies, const Four& four, std::size_t at, Wide a, Wide b,
                                         Wide c, Wide d) {
        transpose(a, b, c, d);
        storeWide(recordOf(bodies[four[0]]) + at, a);
        storeWide(recordOf(bodies[four[1]]) + at, b);
        storeWide(recordOf(bodies[four[2]]) + at, c);
        storeWide(recordOf(bodies[four[3]]) + at, d);
    }
};

namespace {

// Returns the number of bodies that turn too far, listed in `far`. The last group repeats a body in the lanes
// that are left; these write the same values.
CAROM_WIDE std::size_t turnAll(TurningKernel::Record* records, const std::uint32_t* list, std::size_t count,
                               double duration, SolverBody* solved, std::uint32_t* far) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; i += wideLanes) {
        TurningKernel::Four four;
        for (std::size_t lane = 0; lane < wideLanes; ++lane) four[lane] = list[std::min(i + lane, count - 1)];
        const Wide isFar = TurningKernel::turn(records, four, duration, solved);
        if (!anyLane(isFar)) continue;
        for (std::size_t lane = 0; lane < wideLanes && i + lane < count; ++lane)
            if (isFar[static_cast<int>(lane)] != 0) far[found++] = four[lane];
    }
    return found;
}

} // namespace

void TurningBodies::turn(std::span<const std::uint32_t> list, double duration, std::span<SolverBody> solved,
                         Workers& workers) {
    if (list.empty()) return;
    std::vector<std::uint32_t>& numbers = m_far;
    numbers.resize(list.size());
    workers.forRanges(list.size(), fewTurning, [&](std::size_t begin, std::size_t end) {
        const std::size_t far = turnAll(m_records.data(), list.data() + begin, end - begin, duration,
                                        solved.data(), numbers.data() + begin);
        for (const std::uint32_t number : std::span(numbers).subspan(begin, far))
            turnFar(m_records[number], duration, solved[number]);
    });
}

// Turns a body by more than mostAngle; its angular momentum has been updated already.
void TurningBodies::turnFar(Record& record, double duration, SolverBody& solved) const {
    const Vec3 inertia = vectorOf(record.inertia), momentum = vectorOf(record.momentum);
    Quat orientation(Vec4::Map(record.orientation.data()));
    rotateInParts(inertia, momentum, duration, orientation);
    Vec4::Map(record.orientation.data()) = orientation.coeffs();
    if (record.isRound == 0) {
        solved.spin = arrayOf(angularVelocityFrom(inertia, orientation, momentum));
        const Mat3 turn = orientation.toRotationMatrix();
        setInverseInertia(turn * vectorOf(record.inverse).asDiagonal() * turn.transpose(), solved);
    }
    record.spin = solved.spin;
}

} // namespace carom
