// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/explanations.h"

#include "ui/viewport/instances.h"

#include <QColor>
#include <QFontMetrics>
#include <QPainter>

#include <algorithm>

namespace carom {
namespace {

/// States a trail is made of, two seconds at sixty a second, and bodies that have one: more would hide them.
constexpr std::size_t trailLength = 120, mostTrails = 1000;

} // namespace

void Explanations::clear() {
    m_structure.clear();
    m_passed.clear();
    m_partner = noBody;
    m_ghost = {};
}

void Explanations::note(const Pipeline& pipeline, const Snapshot& snapshot) {
    while (!m_passed.empty() && m_passed.back().frame >= snapshot.frame) m_passed.pop_back();
    if (!holds(m_overlays, Overlay::Trails)) {
        m_passed.clear();
        return;
    }
    const std::vector<BodyIndex>& mobile = pipeline.bodies().mobileBodies;
    Passed now{snapshot.frame, {}};
    for (std::size_t i = 0; i < std::min(mobile.size(), mostTrails); ++i)
        now.positions.push_back(snapshot.pose[mobile[i]].position);
    m_passed.push_back(std::move(now));
    if (m_passed.size() > trailLength) m_passed.pop_front();
}

std::vector<std::vector<Vec3>> Explanations::trails() const {
    std::vector<std::vector<Vec3>> trails(m_passed.empty() ? 0 : m_passed.front().positions.size());
    for (const Passed& passed : m_passed)
        for (std::size_t i = 0; i < trails.size(); ++i) trails[i].push_back(passed.positions[i]);
    return trails;
}

std::vector<LineVertex> Explanations::lines(const Pipeline& pipeline, const Snapshot* snapshot) const {
    const std::vector<BodyIndex>& warned = pipeline.warnedBodies();
    if (m_overlays == 0 && !m_ghost.snapshot && warned.empty() && m_partner == noBody &&
        pipeline.scene().springs.empty())
        return {};
    State state = pipeline.initialState();
    if (snapshot != nullptr) {
        state.pose = snapshot->pose;
        state.velocity = snapshot->velocity;
        state.angularVelocity = snapshot->angularVelocity;
    }
    std::vector<TouchingPair> touching;
    // Contacts of a snapshot are found anew: what the simulation knows of them stays on its own thread.
    if (holds(m_overlays, Overlay::Contacts)) touching = touchingPairs(pipeline.bodies(), state);
    std::vector<BodyPair> overlapping;
    if (holds(m_overlays, Overlay::Pairs)) overlapping = overlappingPairs(pipeline.bodies(), state.pose);
    std::vector<std::vector<Vec3>> passed;
    if (holds(m_overlays, Overlay::Trails)) passed = trails();
    GhostState ghost;
    if (m_ghost.snapshot) ghost = {&m_ghost.pipeline->scene(), m_ghost.snapshot->pose};
    return overlayLines(
        m_overlays, {.scene = pipeline.scene(),
                     .poses = state.pose,
                     .velocities = state.velocity,
                     .touching = touching,
                     .forces = snapshot != nullptr ? std::span<const ContactForce>(snapshot->contactForces)
                                                   : std::span<const ContactForce>(),
                     .overlapping = overlapping,
                     .structure = m_structure,
                     .trails = passed,
                     .ghost = ghost,
                     .boxes = pipeline.bodies().boxes,
                     .warned = warned,
                     .size = boundsOf(pipeline.scene(), pipeline.initialState().pose).size().norm(),
                     .arrows = m_arrows,
                     .partner = m_partner});
}

void paintLabels(QPainter& painter, const Scene& scene, std::span<const Pose> poses, const Camera& camera,
                 const PictureSize& size, bool dark) {
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor text = dark ? QColor(235, 238, 242) : QColor(20, 24, 28);
    QColor ground = dark ? QColor(20, 22, 28) : QColor(255, 255, 255);
    ground.setAlpha(170);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].label.empty() || isWall(scene.bodies[i].shape)) continue;
        const std::optional<Eigen::Vector2d> at = projected(camera, size, poses[i].position);
        if (!at || !at->allFinite()) continue;
        const QString words = QString::fromStdString(scene.bodies[i].label);
        QRectF box(painter.fontMetrics().boundingRect(words).adjusted(-4, -1, 4, 1));
        box.moveCenter({at->x(), at->y()});
        painter.setPen(Qt::NoPen);
        painter.setBrush(ground);
        painter.drawRoundedRect(box, 3, 3);
        painter.setPen(text);
        painter.drawText(box, Qt::AlignCenter, words);
    }
}

} // namespace carom
