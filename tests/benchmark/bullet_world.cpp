// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/peer.h"

#include "tests/benchmark/bullet_vectors.h"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

btScalar smallerRestitution(const btCollisionObject* a, const btCollisionObject* b) {
    return std::min(a->getRestitution(), b->getRestitution());
}
btScalar meanFriction(const btCollisionObject* a, const btCollisionObject* b) {
    return std::sqrt(a->getFriction() * b->getFriction());
}

std::unique_ptr<btCollisionShape> shapeFor(const Shape& shape) {
    if (const Sphere* sphere = std::get_if<Sphere>(&shape))
        return std::make_unique<btSphereShape>(sphere->radius);
    if (const Wall* wall = std::get_if<Wall>(&shape))
        return std::make_unique<btStaticPlaneShape>(toBullet(wall->normal), wall->offset);
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape))
        return std::make_unique<btCylinderShape>(
            btVector3(cylinder->radius, cylinder->halfHeight, cylinder->radius));
    return std::make_unique<btBoxShape>(toBullet(std::get<Cuboid>(shape).halfSize));
}

class BulletWorld final : public PeerWorld {
  public:
    BulletWorld(std::shared_ptr<const Pipeline> pipeline, const PeerSettings& settings)
        : m_pipeline(std::move(pipeline)), m_settings(settings) {
        m_world.setGravity(toBullet(m_pipeline->gravity()));
        if (settings.iterations > 0) m_world.getSolverInfo().m_numIterations = settings.iterations;
        if (settings.tuned) {
            gCalculateCombinedRestitutionCallback = smallerRestitution;
            gCalculateCombinedFrictionCallback = meanFriction;
            m_world.setForceUpdateAllAabbs(false); // what cannot move keeps its box
            m_world.getSolverInfo().m_restitutionVelocityThreshold = 0;
        }
        const Bodies& bodies = m_pipeline->bodies();
        const State& state = m_pipeline->initialState();
        for (std::size_t i = 0; i < bodies.count(); ++i) {
            m_shapes.push_back(shapeFor(bodies.shape[i]));
            btRigidBody::btRigidBodyConstructionInfo info(bodies.mass[i], nullptr, m_shapes.back().get(),
                                                          toBullet(bodies.inertia[i]));
            if (!bodies.mobile[i]) info.m_mass = 0;
            info.m_startWorldTransform =
                btTransform(toBullet(state.pose[i].orientation), toBullet(state.pose[i].position));
            info.m_friction = bodies.friction[i];
            info.m_restitution = bodies.elastic[i];
            m_bodies.push_back(std::make_unique<btRigidBody>(info));
            btRigidBody& body = *m_bodies.back();
            body.setLinearVelocity(toBullet(state.velocity[i]));
            body.setAngularVelocity(toBullet(state.angularVelocity[i]));
            if (settings.tuned) body.setActivationState(DISABLE_DEACTIVATION);
            m_world.addRigidBody(&body);
        }
    }
    ~BulletWorld() override {
        for (const std::unique_ptr<btRigidBody>& body : m_bodies) m_world.removeRigidBody(body.get());
    }

    std::string name() const override { return "Bullet " + std::to_string(btGetVersion()); }
    std::vector<std::string> differences() const override {
        std::vector<std::string> rules = {"friction acts along the direction of sliding alone"};
        if (m_settings.tuned) return rules;
        rules.push_back("a pair has the product of its coefficients of restitution, and of friction");
        rules.push_back("impacts slower than 0.2 m/s do not bounce");
        rules.push_back("bodies slower than 0.8 m/s for 2 s are put to sleep");
        return rules;
    }
    void step() override {
        for (int k = 0; k < m_settings.substeps; ++k)
            m_world.stepSimulation(m_pipeline->settings().step / m_settings.substeps, 0);
    }

    void read(State& state) const override {
        for (std::size_t i = 0; i < m_bodies.size(); ++i) {
            if (!m_pipeline->bodies().mobile[i]) continue;
            const btTransform& transform = m_bodies[i]->getWorldTransform();
            state.pose[i] = {fromBullet(transform.getOrigin()), fromBullet(transform.getRotation())};
            state.velocity[i] = fromBullet(m_bodies[i]->getLinearVelocity());
            state.angularVelocity[i] = fromBullet(m_bodies[i]->getAngularVelocity());
        }
    }

  private:
    std::shared_ptr<const Pipeline> m_pipeline;
    PeerSettings m_settings;
    btDefaultCollisionConfiguration m_configuration;
    btCollisionDispatcher m_dispatcher{&m_configuration};
    btDbvtBroadphase m_broadphase;
    btSequentialImpulseConstraintSolver m_solver;
    btDiscreteDynamicsWorld m_world{&m_dispatcher, &m_broadphase, &m_solver, &m_configuration};
    std::vector<std::unique_ptr<btCollisionShape>> m_shapes;
    std::vector<std::unique_ptr<btRigidBody>> m_bodies;
};

} // namespace

std::unique_ptr<PeerWorld> makePeerWorld(std::shared_ptr<const Pipeline> pipeline,
                                         const PeerSettings& settings) {
    return std::make_unique<BulletWorld>(std::move(pipeline), settings);
}

} // namespace carom
