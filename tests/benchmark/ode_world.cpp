// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/peer.h"

#include <ode/ode.h>

#include <array>
#include <cmath>
#include <numbers>

namespace carom {
namespace {

static_assert(sizeof(dReal) == sizeof(double));

/// ODE's cylinders stand along z, ours along y: a quarter turn about x between the two.
const Quat zFromY = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));

class OdeWorld final : public PeerWorld {
  public:
    OdeWorld(std::shared_ptr<const Pipeline> pipeline, const PeerSettings& settings)
        : m_pipeline(std::move(pipeline)), m_settings(settings) {
        dInitODE();
        m_world = dWorldCreate();
        m_space = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
        m_contacts = dJointGroupCreate(0);
        const Vec3 gravity = m_pipeline->gravity();
        dWorldSetGravity(m_world, gravity.x(), gravity.y(), gravity.z());
        if (settings.iterations > 0) dWorldSetQuickStepNumIterations(m_world, settings.iterations);
        const Bodies& bodies = m_pipeline->bodies();
        for (BodyIndex i = 0; i < bodies.count(); ++i) {
            m_geoms.push_back(geomFor(bodies.shape[i]));
            m_bodies.push_back(nullptr);
            dGeomSetData(m_geoms[i], reinterpret_cast<void*>(static_cast<std::uintptr_t>(i)));
            if (!isWall(bodies.shape[i])) placeBody(i);
        }
    }
    ~OdeWorld() override {
        dJointGroupDestroy(m_contacts);
        dSpaceDestroy(m_space);
        dWorldDestroy(m_world);
        dCloseODE();
    }

    std::string name() const override { return "ODE " + std::string(dODE_VERSION); }

    std::vector<std::string> differences() const override {
        if (m_settings.tuned) return {"friction acts along two fixed directions, each with its own limit"};
        return {"friction is a force of a fixed size, along two fixed directions"};
    }
    void step() override {
        for (int k = 0; k < m_settings.substeps; ++k) {
            dSpaceCollide(m_space, this,
                          [](void* self, dGeomID a, dGeomID b) { static_cast<OdeWorld*>(self)->meet(a, b); });
            // 20 iterations are its default.
            dWorldQuickStep(m_world, m_pipeline->settings().step / m_settings.substeps);
            dJointGroupEmpty(m_contacts);
        }
    }

    void read(State& state) const override {
        const auto vector = [](const dReal* v) { return Vec3(v[0], v[1], v[2]); };
        for (std::size_t i = 0; i < m_bodies.size(); ++i) {
            if (!m_bodies[i]) continue;
            const dReal* const q = dBodyGetQuaternion(m_bodies[i]);
            state.pose[i] = {vector(dBodyGetPosition(m_bodies[i])), Quat(q[0], q[1], q[2], q[3])};
            state.velocity[i] = vector(dBodyGetLinearVel(m_bodies[i]));
            state.angularVelocity[i] = vector(dBodyGetAngularVel(m_bodies[i]));
        }
    }

  private:
    dGeomID geomFor(const Shape& shape) const {
        if (const Sphere* sphere = std::get_if<Sphere>(&shape)) return dCreateSphere(m_space, sphere->radius);
        if (const Wall* wall = std::get_if<Wall>(&shape))
            return dCreatePlane(m_space, wall->normal.x(), wall->normal.y(), wall->normal.z(), wall->offset);
        if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape))
            return dCreateCylinder(m_space, cylinder->radius, 2 * cylinder->halfHeight);
        const Vec3 size = 2 * std::get<Cuboid>(shape).halfSize;
        return dCreateBox(m_space, size.x(), size.y(), size.z());
    }

    void placeBody(BodyIndex i) {
        const Bodies& bodies = m_pipeline->bodies();
        const State& state = m_pipeline->initialState();
        const Pose& pose = state.pose[i];
        const bool isCylinder = std::holds_alternative<Cylinder>(bodies.shape[i]);
        const Quat turned = pose.orientation * (isCylinder ? zFromY : Quat::Identity());
        if (!bodies.mobile[i]) {
            const dQuaternion q = {turned.w(), turned.x(), turned.y(), turned.z()};
            dGeomSetPosition(m_geoms[i], pose.position.x(), pose.position.y(), pose.position.z());
            dGeomSetQuaternion(m_geoms[i], q);
            return;
        }
        const dBodyID body = m_bodies[i] = dBodyCreate(m_world);
        dMass mass;
        const Vec3& inertia = bodies.inertia[i];
        dMassSetParameters(&mass, bodies.mass[i], 0, 0, 0, inertia.x(), inertia.y(), inertia.z(), 0, 0, 0);
        dBodySetMass(body, &mass);
        dGeomSetBody(m_geoms[i], body);
        if (isCylinder) {
            const dQuaternion offset = {zFromY.w(), zFromY.x(), zFromY.y(), zFromY.z()};
            dGeomSetOffsetQuaternion(m_geoms[i], offset);
        }
        const dQuaternion q = {pose.orientation.w(), pose.orientation.x(), pose.orientation.y(),
                               pose.orientation.z()};
        dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
        dBodySetQuaternion(body, q);
        dBodySetLinearVel(body, state.velocity[i].x(), state.velocity[i].y(), state.velocity[i].z());
        const Vec3& omega = state.angularVelocity[i];
        dBodySetAngularVel(body, omega.x(), omega.y(), omega.z());
        dBodySetAutoDisableFlag(body, 0);
    }

    void meet(dGeomID a, dGeomID b) {
        const auto indexOf = [](dGeomID geom) {
            return reinterpret_cast<std::uintptr_t>(dGeomGetData(geom));
        };
        const Bodies& bodies = m_pipeline->bodies();
        const std::size_t i = indexOf(a), j = indexOf(b);
        if (!m_bodies[i] && !m_bodies[j]) return;
        std::array<dContact, 8> contacts = {};
        const int count =
            dCollide(a, b, static_cast<int>(contacts.size()), &contacts[0].geom, sizeof(dContact));
        for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
            dSurfaceParameters& surface = contacts[k].surface;
            surface.mode = m_settings.tuned ? dContactBounce | dContactApprox1 : dContactBounce;
            surface.mu = std::sqrt(bodies.friction[i] * bodies.friction[j]);
            surface.bounce = std::min(bodies.elastic[i], bodies.elastic[j]);
            surface.bounce_vel = 0;
            dJointAttach(dJointCreateContact(m_world, m_contacts, &contacts[k]), m_bodies[i], m_bodies[j]);
        }
    }

    std::shared_ptr<const Pipeline> m_pipeline;
    PeerSettings m_settings;
    dWorldID m_world = nullptr;
    dSpaceID m_space = nullptr;
    dJointGroupID m_contacts = nullptr;
    std::vector<dGeomID> m_geoms;
    std::vector<dBodyID> m_bodies; ///< null for what cannot move
};

} // namespace

std::unique_ptr<PeerWorld> makePeerWorld(std::shared_ptr<const Pipeline> pipeline,
                                         const PeerSettings& settings) {
    return std::make_unique<OdeWorld>(std::move(pipeline), settings);
}

} // namespace carom
