// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/race.h"

#include "core/base/figures.h"
#include "core/base/text.h"
#include "core/simulation/world.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace carom {

std::optional<std::string> objectionToRace(const Pipeline& a, const Pipeline& b) {
    const std::vector<BodyIndex>&mobileA = a.bodies().mobileBodies, &mobileB = b.bodies().mobileBodies;
    if (mobileA != mobileB)
        return "the two scenes have other bodies (" + std::to_string(mobileA.size()) + " and " +
               std::to_string(mobileB.size()) + " that move); they must be alike in number and order";
    if (a.settings().step != b.settings().step)
        return "the two runs have frames of different length (" + shortest(a.settings().step) + " s and " +
               shortest(b.settings().step) + " s); give both the same `step`";
    return std::nullopt;
}

Race::Race(std::shared_ptr<const Pipeline> a, std::shared_ptr<const Pipeline> b)
    : m_a(std::make_unique<World>(std::move(a))), m_b(std::make_unique<World>(std::move(b))) {
    look();
}

Race::~Race() = default;

bool Race::isFinite() const { return m_a->health().finite && m_b->health().finite; }

bool Race::step() {
    m_a->step();
    m_b->step();
    if (isFinite()) look();
    return isFinite();
}

void Race::look() {
    m_now = {m_a->state().frame, m_a->state().time, distanceBetween(*m_a, *m_b)};
    if (!m_first) m_first = carom::firstDifference(*m_a, *m_b);
}

void RaceRecording::add(const Race& race) {
    const RacePoint& point = race.now();
    std::optional<Moment> moment;
    if (point.frame % m_stride == 0) // the stride is this thread's own
        moment = {point.frame, std::make_shared<const Snapshot>(race.a().snapshot()),
                  std::make_shared<const Snapshot>(race.b().snapshot())};
    const std::lock_guard lock(m_mutex);
    m_points.push_back(point);
    m_first = race.firstDifference();
    if (!moment) return;
    m_moments.push_back(std::move(*moment));
    constexpr std::size_t oneBody = sizeof(Pose) + 2 * sizeof(Vec3);
    const std::size_t oneMoment = 2 * m_moments.back().a->pose.size() * oneBody;
    if (m_moments.size() > 2 && m_moments.size() * oneMoment > m_budget) thinOut();
}

void RaceRecording::thinOut() {
    m_stride *= 2;
    std::erase_if(m_moments, [this](const Moment& moment) { return moment.frame % m_stride != 0; });
}

std::int64_t RaceRecording::count() const {
    const std::lock_guard lock(m_mutex);
    return static_cast<std::int64_t>(m_points.size());
}

std::vector<RacePoint> RaceRecording::pointsFrom(std::int64_t first) const {
    const std::lock_guard lock(m_mutex);
    if (first >= static_cast<std::int64_t>(m_points.size())) return {};
    return {m_points.begin() + first, m_points.end()};
}

std::optional<RaceRecording::Moment> RaceRecording::at(std::int64_t frame) const {
    const std::lock_guard lock(m_mutex);
    const auto behind = std::ranges::upper_bound(m_moments, frame, {}, &Moment::frame);
    if (behind == m_moments.begin()) return std::nullopt;
    return *std::prev(behind);
}

std::optional<BitDifference> RaceRecording::firstDifference() const {
    const std::lock_guard lock(m_mutex);
    return m_first;
}

void addRow(CsvTable& table, const RacePoint& point, const Scene& scene) {
    const auto& [distance, body] = point.apart;
    const bool nowhere = body == noBody;
    table.row(point.frame, point.time, distance, nowhere ? std::int64_t{-1} : std::int64_t{body},
              nowhere ? std::string() : scene.bodies[body].label);
}

std::string describe(const Scene& scene, const BitDifference& difference, double step) {
    return "frame " + std::to_string(difference.frame) + ", " +
           figure(static_cast<double>(difference.frame) * step, 6) +
           " s: " + std::string(difference.quantity) + " of " + scene.nameOf(difference.body);
}

std::string settingOf(const RunSettings& settings) {
    return "preset " + std::string(settings.preset->name) + ", method " + std::string(settings.method->name) +
           ", " + counted(static_cast<std::size_t>(settings.substeps), "substep", "substeps") + " a frame";
}

} // namespace carom
