// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/contact_constraint.h"
#include "core/dynamics/forced_steps.h"
#include "core/dynamics/spring_steps.h"
#include "core/dynamics/state.h"
#include "core/dynamics/work_counters.h"
#include "core/narrowphase/time_of_impact.h"
#include "core/solvers/contacts/contact_problem.h"
#include "core/solvers/contacts/impacts.h"
#include "core/solvers/contacts/islands.h"
#include "core/solvers/contacts/newton.h"
#include "core/solvers/contacts/spring_solver.h"
#include "core/solvers/contacts/work_budget.h"
#include "core/solvers/solver.h"

#include <limits>
#include <vector>

// Moves the bodies of one island through a substep. The order of operations:
//
//     until the substep is used up
//         positions  overlaps are corrected, without any change of kinetic energies
//         impacts    contacts that touch and close at a speed change velocities at once (impacts.h)
//         velocities v̂ = v + T g, contact forces keep bodies apart: v₁
//         events     if an open contact closes with an impact before T, or a sliding one stops, T ends there
//         commit     x += T (v₀ + v₁)/2, rotation likewise
//
// v₀ is the velocity after the impacts. With the mean of both ends parabolas are exact, and so is the
// deceleration by friction; both ends obey the bound of the gap, so the mean does. Contacts that turn with
// their bodies are used as they will be at the end (island_turning.cpp). Cylinders that stand can be
// supported at any point of their rim (island_rims.cpp).
//
// An island on springs in which no bodies meet needs none of this: it is integrated to order four
// (dynamics/spring_steps.h), unless its springs are too stiff for the substep.

namespace carom {

/// Input of an island's motion, besides its contacts.
struct MotionInput {
    const Bodies& bodies;
    const SolverSettings& settings;
    Vec3 gravity;       ///< [m/s²]
    double substep = 0; ///< [s]
    State& state;
    Ledger* ledger = nullptr;
    double budget = std::numeric_limits<double>::infinity(); ///< operations (work_budget.h)
};

/// Report on the motion of islands in one substep.
struct MotionReport {
    double residual = 0;       ///< the worst of any island's contact problem [m/s]
    double maxPenetration = 0; ///< [m]
    WorkCounters work;
    Loss loss; ///< set if the forces of an island are not finite; it has not moved
};

/// The inertia of a body as it lies in the world.
void setInertia(const Vec3& principal, const Quat& orientation, ContactBody& body);

class IslandMotion {
  public:
    /// Changes the state of the island's bodies. `found` holds the contacts at the start of the substep. True
    /// if the island has not moved: nothing had a velocity before or after, and nothing overlapped.
    bool advance(const MotionInput& input, const Island& island, const ContactSet& found);
    /// The part of the substep that is left because the budget ended or the forces were not found [s]: the
    /// bodies have been moved up to its beginning.
    double left() const { return m_left; }
    /// Work of the motion [operations].
    double work() const { return m_work; }
    /// Contacts at the end, with their forces, for the pairs of the island; a pair may have lost its points.
    const ContactSet& contacts() const { return m_contacts; }

    MotionReport report; ///< added up by advance

  private:
    struct Braked;
    /// A velocity, and the position it leads from.
    struct Start {
        Vec6 velocity = Vec6::Zero();
        Vec3 angularMomentum = Vec3::Zero();
    };
    /// The place of a contact point at another time of the part.
    struct Place {
        bool found = false;
        Mat3 frame = Mat3::Identity();
        Vec3 armA = Vec3::Zero(), armB = Vec3::Zero();
    };
    /// Where a contact point is on both bodies of its pair [m].
    struct SeenPoint {
        Vec3 onA = Vec3::Zero(), onB = Vec3::Zero();
    };
    /// A round in which contacts turn: where it led a body, and by how much it changed that.
    struct Round {
        Vec6 end = Vec6::Zero(), change = Vec6::Zero(); // velocities
    };
    /// The impulses of a row after it.
    struct RowRound {
        Vec3 impulse = Vec3::Zero();
        Vec2 rolling = Vec2::Zero();
    };
    /// The end of a spring before and after a part [m], and its arm from the body's centre.
    struct SpringEnd {
        int body = immobile; // of m_problem
        Vec3 before = Vec3::Zero(), after = Vec3::Zero(), arm = Vec3::Zero();
    };
    /// The Jacobians along which the impulse of a row acts.
    struct Push {
        Mat36 a = Mat36::Zero(), b = Mat36::Zero();
        Mat3 frame = Mat3::Identity();
    };

    double remaining(const MotionInput& input) const { return input.budget - m_work; }
    double collideWork(const Bodies& bodies, const ContactPair& pair) const;
    void load(const MotionInput& input, const Island& island, const ContactSet& found);
    void move(const MotionInput& input, const Island& island);
    bool integrateSprings(const MotionInput& input, const Island& island);
    bool staysApart(const MotionInput& input) const;
    void recollide(const MotionInput& input);
    void loadBodies(const MotionInput& input, const Island& island);
    double relativeOverlap() const;
    void correctPositions(const MotionInput& input, const Island& island);
    double storedInSprings(const MotionInput& input) const;
    void takeEnergy(const MotionInput& input, const Island& island, double energy);
    void impacts(const MotionInput& input, double duration, bool findsImpacts);
    void solveVelocities(const MotionInput& input, double duration, bool findsImpacts);
    void solveFiner(const MotionInput& input, double duration, bool findsImpacts);
    double solvePart(const MotionInput& input, double duration, bool findsImpacts);
    double lessSunkIn(const MotionInput& input, double duration);
    void beginPart(const MotionInput& input, double duration);
    Vec3 endMomentum(std::size_t body) const;
    void chooseRows(const MotionInput& input, double duration, bool findsImpacts);
    void solve(const MotionInput& input);
    void solveForces(const MotionInput& input, double duration);
    void keepForces(double duration);
    void holdRims(const MotionInput& input, double duration, bool findsImpacts);
    double addRimPoints(const MotionInput& input, bool fastest);
    Vec3 centreOfPressure(const Bodies& bodies, std::uint32_t pair) const;
    bool insertPoint(std::uint32_t pair, const ContactConstraint& point);
    void beginTerms(const MotionInput& input, double duration);
    void applyTerms();
    bool followTerms(const MotionInput& input);
    void endTerms(const MotionInput& input);
    void recordTerms(const MotionInput& input);
    NewtonReport solveCold(const MotionInput& input, const NewtonReport& warm);
    bool contactsTurn(const MotionInput& input, double duration) const;
    void reserve();
    bool losesPoint(const MotionInput& input) const;
    void turnContacts(const MotionInput& input, double duration);
    void predictPoses(const MotionInput& input, double duration);
    void moveRows(const MotionInput& input);
    static SeenPoint seenAt(const Bodies& bodies, const ContactPair& pair, const Pose& poseA,
                            const Pose& poseB, const ContactConstraint& point);
    void findWays(const MotionInput& input, const ContactPair& pair, const Pose& poseA, const Pose& poseB);
    void followPair(const MotionInput& input, const ContactPair& pair, const std::vector<Pose>& poses,
                    std::vector<Place>& places);
    void placeRow(const Place& place, ContactRow& row) const;
    void placeRow(std::uint32_t point, ContactRow& row) const;
    void solveTurned(const MotionInput& input);
    void mixRounds(bool extrapolates);
    Pose middlePose(const MotionInput& input, BodyIndex body, double duration) const;
    void linkSprings(const MotionInput& input, double duration);
    void solveSprings(const MotionInput& input, double duration);
    bool solveSpringsAlone(const MotionInput& input, double duration);
    SpringEnd springEnd(const MotionInput& input, BodyIndex body, const Vec3& point, double duration) const;
    void rememberVelocities();
    double changeOfVelocities();
    double firstImpact(const MotionInput& input, double duration);
    bool mayMeet(const MotionInput& input, std::uint32_t p, double duration) const;
    bool gainsEnergy(const MotionInput& input, double duration, double most) const;
    bool pushesApart() const;
    double workOfFriction() const;
    bool mayMissImpact(const MotionInput& input, double duration);
    bool sinkIn(const MotionInput& input, double duration);
    double overlapOf(const ContactPair& pair) const;
    double overlapAt(const MotionInput& input, const ContactPair& pair, double time, double duration) const;
    double relocated(const MotionInput& input, double duration);
    double firstStop(const MotionInput& input, double duration);
    double findStopTime(const MotionInput& input, const Braked& braked, double duration);
    Loss findLoss(const Island& island) const;
    void commit(const MotionInput& input, const Island& island, double duration);
    bool isWithin(double factor) const;
    void stopPivoting(const MotionInput& input, const Island& island);
    void settle(const MotionInput& input, const Island& island);

    void recordForces(const MotionInput& input, double duration);
    void swapPushes();
    void recordTurning(const MotionInput& input, const Island& island);
    void recordPositionCorrection(const MotionInput& input, const Island& island);

    bool findStop(Braked& first) const;
    double speedOf(const Braked& braked) const;
    void markHeld();
    double gentleClosing(const ContactPair& pair) const;
    double gentleOpening(const ContactPair& pair) const;
    bool isElasticOnSprings(const ContactPair& pair) const;
    double fastestApproach(const MotionInput& input, const ContactPair& pair) const;
    bool isDeep(const MotionInput& input, const ContactPair& pair, double time, double duration);
    bool anyDeep(const MotionInput& input, double duration);
    double lessDeep(const MotionInput& input, const ContactPair& pair, double time, double duration);
    bool anyWaits(const ContactPair& pair) const;
    bool waitsAt(const MotionInput& input, const ContactPair& pair, const Pose& poseA, const Pose& poseB,
                 const Vec3& place) const;
    double nextContact(const MotionInput& input, const ContactPair& pair, double first, double duration);
    double nextCorner(const MotionInput& input, const ContactPair& pair, double first, double duration) const;
    double impactTime(const MotionInput& input, const ContactPair& pair, double time, double duration) const;
    double cornerTime(const MotionInput& input, const ContactPair& pair, const ContactConstraint& point,
                      double t, double duration) const;
    MovingShape movingShape(const MotionInput& input, BodyIndex body, double duration) const;
    Pose poseAt(const MotionInput& input, BodyIndex body, double t, double duration) const;
    Vec3 velocityAt(BodyIndex body, const Vec3& arm, double t, double duration) const;

    ContactRow rowOf(const Bodies& bodies, const ContactPair& pair, const ContactConstraint& point) const;
    int localOf(BodyIndex body) const { return m_local[body]; }

    double m_work = 0;     // operations in this substep
    double m_left = 0;     // of the substep [s]
    double m_residual = 0; // of the last solve [m/s]
    double m_overlap = 0;  // the deepest in this substep, relative to the smaller body
    struct Uncorrected {
        Pose pose;
        Vec3 velocity, angularVelocity, angularMomentum;
    };
    std::vector<Uncorrected> m_uncorrected; // by body of the island: before its position was corrected
    bool m_isCorrected = false;             // in this substep
    bool m_unsolved = false;                // the forces of this part were not found
    bool m_isColdInVain = false;            // forces of this part were not found without a first guess either
    bool m_turnsTooFar = false;             // contacts cannot be followed through this part
    bool m_rollsOn = false;                 // a contact without a force sinks in from the start of this part
    bool m_rattles = false;                 // most of the events of this substep are used up
    double m_scale = 0;                     // |g| h, or the speed of the problem without gravity [m/s]
    double m_tolerance = 0;                 // of velocities [m/s]
    double m_still = 0;                     // what is no faster is at rest [m/s]
    std::vector<int> m_local;               // by body of the scene: its index in m_problem, or immobile
    std::span<const BodyIndex> m_members;   // of the scene, by body of m_problem
    ContactSet m_contacts, m_before;
    ContactProblem m_problem, m_correction;
    std::vector<std::uint32_t> m_springs;      // of the island, into Bodies::springs
    std::vector<Mat3> m_springSlopes;          // by spring of the island
    std::vector<Vec6> m_lastVelocity;          // by body of m_problem, of the round before
    double m_fastest = 0;                      // body then [m/s]
    std::vector<Start> m_start;                // by body of m_problem
    ForcedSteps m_forced;                      // of the bodies that force terms act on
    std::vector<Pose> m_middlePose, m_endPose; // by body of m_problem, foreseen
    std::vector<Place> m_inMiddle, m_atEnd;    // by point of m_contacts, foreseen
    std::vector<Round> m_rounds;               // by body of m_problem: the round before
    std::vector<RowRound> m_rowRounds;         // by row, the same
    std::vector<Push> m_pushes;                // by row; empty: along the rows themselves
    std::vector<Vec6> m_free;                  // by body of m_problem, v̂
    std::vector<std::uint8_t> m_presses;       // by point, 1: an impulse acts in it
    ContactSet m_followed;                     // of one pair
    std::vector<SeenPoint> m_seenThere;        // its points
    std::vector<double> m_ways;                // by point of the pair, and by one of these
    std::vector<std::uint32_t> m_unused;       // of these
    std::vector<ContactConstraint> m_onRims;   // of one pair
    std::vector<std::uint32_t> m_rowPoint;     // by row, the point of m_contacts
    std::vector<std::uint8_t> m_stuck;         // by row, 1: it neither slid nor rolled when last solved for
    std::vector<std::uint8_t> m_waits;         // by point, 1: open, and may close hard within the substep
    std::vector<std::uint8_t> m_held;          // by pair, 1: a contact force acts in it
    std::vector<std::uint8_t> m_pushed;  // by body of m_problem, 1: something besides gravity acts on it
    std::vector<std::uint32_t> m_pairOf; // by point, the pair of m_contacts
    std::vector<Vec6> m_mean;            // by body of m_problem, the mean velocity; for the ledger only
    std::vector<ImpactRow> m_impactRows;
    std::vector<ContactRow> m_warmRows; // of m_problem, after a first attempt
    NewtonSolver m_newton;
    SpringSolver m_springSolver;
    SpringSteps m_springSteps;
    SpringNetwork::Scratch m_springScratch;
    ImpactSolver m_impacts;
};

} // namespace carom
