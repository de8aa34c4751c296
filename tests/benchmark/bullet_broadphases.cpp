// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/peer.h"

#include "tests/benchmark/bullet_vectors.h"

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>

namespace carom {
namespace {

class BulletBroadphase final : public Broadphase {
  public:
    using Maker = std::unique_ptr<btBroadphaseInterface> (*)(const Aabb& space, std::size_t boxes);
    explicit BulletBroadphase(Maker make) : m_make(make) {}
    ~BulletBroadphase() override {
        for (btBroadphaseProxy* proxy : m_proxies) m_engine->destroyProxy(proxy, &m_dispatcher);
    }

    void update(const BroadphaseInput& input) override {
        if (!m_engine) start(input);
        for (std::size_t i = 0; i < m_proxies.size(); ++i)
            m_engine->setAabb(m_proxies[i], toBullet(input.boxes[i].lower), toBullet(input.boxes[i].upper),
                              &m_dispatcher);
        m_engine->calculateOverlappingPairs(&m_dispatcher);
        m_counters.boxes = input.boxes.size();
        m_counters.pairs =
            static_cast<std::uint64_t>(m_engine->getOverlappingPairCache()->getNumOverlappingPairs());
    }

  private:
    void start(const BroadphaseInput& input) {
        Aabb space = input.boxes.front();
        for (const Aabb& box : input.boxes) space = united(space, box);
        m_engine = m_make(grown(space, 0.1 * space.size().maxCoeff()), input.boxes.size());
        for (const Aabb& box : input.boxes)
            m_proxies.push_back(m_engine->createProxy(toBullet(box.lower), toBullet(box.upper), 0, this,
                                                      btBroadphaseProxy::AllFilter,
                                                      btBroadphaseProxy::AllFilter, &m_dispatcher));
    }

    Maker m_make;
    btDefaultCollisionConfiguration m_configuration;
    btCollisionDispatcher m_dispatcher{&m_configuration};
    std::unique_ptr<btBroadphaseInterface> m_engine;
    std::vector<btBroadphaseProxy*> m_proxies;
};

} // namespace

std::unique_ptr<Broadphase> makeBulletTree() {
    return std::make_unique<BulletBroadphase>(
        [](const Aabb&, std::size_t) -> std::unique_ptr<btBroadphaseInterface> {
            return std::make_unique<btDbvtBroadphase>();
        });
}

std::unique_ptr<Broadphase> makeBulletSweep() {
    return std::make_unique<BulletBroadphase>(
        [](const Aabb& space, std::size_t boxes) -> std::unique_ptr<btBroadphaseInterface> {
            constexpr std::size_t mostInSixteenBits = 16383;
            const btVector3 lower = toBullet(space.lower), upper = toBullet(space.upper);
            if (boxes < mostInSixteenBits)
                return std::make_unique<btAxisSweep3>(lower, upper, static_cast<unsigned short>(boxes + 1));
            return std::make_unique<bt32BitAxisSweep3>(lower, upper, static_cast<unsigned int>(boxes + 1));
        });
}

} // namespace carom
