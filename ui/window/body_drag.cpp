// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/body_drag.h"

#include "core/language/number_rewrite.h"
#include "core/math/rotation.h"
#include "ui/base/keys.h"
#include "ui/editor/scene_editor.h"
#include "ui/player/simulation.h"
#include "ui/viewport/overlays.h"
#include "ui/viewport/viewport.h"
#include "ui/window/live_preview.h"

#include <QApplication>
#include <QKeyEvent>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

namespace carom {
namespace {

constexpr double degreesPerRadian = 180 / std::numbers::pi;
/// A number without decimals moves in steps of no more than this [px].
constexpr double coarsest = 20;
constexpr int decimalsOfDegrees = 2;
constexpr double directionStep = 1e-3; ///< of a direction's length

/// Decimals that a length of so much can be told by.
int decimalsOf(double length) {
    constexpr int most = 12;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(std::max(length, 1e-300)))), 0, most);
}

double rounded(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);
    return std::round(value * scale) / scale;
}

/// The parameter that a handle stands for; empty where the body has none.
std::string_view parameterOf(const Body& body, BodyHandle handle) {
    switch (handle) {
    case BodyHandle::Centre:
        return "centre";
    case BodyHandle::Velocity:
        return "vel";
    case BodyHandle::Turn:
        return std::holds_alternative<Cylinder>(body.shape) ? "axis"
               : std::holds_alternative<Cuboid>(body.shape) ? "rotation"
                                                            : "";
    }
    return {};
}

/// A cuboid need not give its rotation: where it could, and as what.
constexpr std::string_view insertedRotation = " rotation 0, 0, 0";

struct PlaceOfValue {
    SourceRange range; ///< to be replaced
    std::string text;  ///< by this, with other numbers
};

std::optional<PlaceOfValue> placeOf(const Build& build, BodyIndex body, BodyHandle handle) {
    const Scene& scene = build.analysis.scene;
    const DeclarationSource& source = scene.bodies[body].source;
    const std::string_view parameter = parameterOf(scene.bodies[body], handle);
    if (parameter.empty()) return std::nullopt;
    const auto given = [&](std::string_view name) { return scene.find(source, name); };
    if (const ParameterSource* value = given(parameter))
        return PlaceOfValue{value->value, std::string(textOf(build.analysis.text, value->value))};
    const ParameterSource* centre = parameter == "rotation" ? given("centre") : nullptr;
    if (centre == nullptr) return std::nullopt;
    return PlaceOfValue{{centre->value.end(), 0}, std::string(insertedRotation)};
}

} // namespace

BodyDrag::BodyDrag(SceneEditor& editor, Viewport& viewport, Simulation& simulation, const LiveBuild& builds,
                   const LivePreview& preview)
    : QObject(&editor), m_editor(editor), m_viewport(viewport), m_simulation(simulation), m_builds(builds),
      m_preview(preview) {
    viewport.setMayDrag([this](BodyIndex body, BodyHandle handle) { return mayDrag(body, handle); });
    connect(&viewport, &Viewport::dragBegan, this, &BodyDrag::begin);
    connect(&viewport, &Viewport::dragged, this, &BodyDrag::moveTo);
    connect(&viewport, &Viewport::dragEnded, this, &BodyDrag::end);
    connect(&editor, &SceneEditor::aboutToBeReplaced, this, &BodyDrag::end);
}

/// The text must be the one on screen, and give the value in numbers.
bool BodyDrag::mayDrag(BodyIndex body, BodyHandle handle) const {
    if (m_dragging || !m_simulation.isAtStart() || m_simulation.isRunning() || !m_builds.isCurrent())
        return false;
    if (!m_preview.shown() ||
        m_builds.latest()->scene().bodies.size() != m_preview.shown()->scene().bodies.size())
        return false;
    const std::optional<PlaceOfValue> place = placeOf(m_builds.latest()->build, body, handle);
    return place && numbersOf(place->text).size() == 3;
}

void BodyDrag::begin(BodyIndex body, BodyHandle handle) {
    const std::optional<PlaceOfValue> place = placeOf(m_builds.latest()->build, body, handle);
    if (!place) return;
    m_handle = handle;
    m_isAxis = std::holds_alternative<Cylinder>(m_builds.latest()->scene().bodies[body].shape);
    m_original = place->text;
    const std::vector<double> numbers = numbersOf(m_original);
    m_start = {numbers[0], numbers[1], numbers[2]};
    m_offset = place->range.offset;
    m_written = m_editor.bytesOf(place->range);
    m_dragging = true;
    m_editor.beginUndoAction();
    qApp->installEventFilter(this);
}

/// What is to be written: metres, metres a second, degrees, or a direction as long as the one before.
Vec3 BodyDrag::valueOf(const DraggedBody& now) const {
    if (m_handle == BodyHandle::Centre) return now.pose.position;
    if (m_handle == BodyHandle::Velocity) return now.velocity;
    if (m_isAxis) return m_start.norm() * (now.pose.orientation * Vec3::UnitY());
    return degreesPerRadian * toRotationVector(now.pose.orientation);
}

void BodyDrag::moveTo(const DraggedBody& now) {
    if (!m_dragging) return;
    const double pixel =
        m_handle == BodyHandle::Velocity ? m_viewport.pixelSize() / velocityTime : m_viewport.pixelSize();
    int visible = decimalsOf(pixel), least = decimalsOf(coarsest * pixel);
    if (m_handle == BodyHandle::Turn)
        visible = least = m_isAxis ? decimalsOf(directionStep * m_start.norm()) : decimalsOfDegrees;
    const double unmoved = m_handle == BodyHandle::Turn ? std::pow(10.0, -visible) / 2 : 1e-6 * pixel;
    Vec3 value = valueOf(now);
    for (const int axis : {0, 1, 2}) {
        const double change = std::abs(value[axis] - m_start[axis]);
        value[axis] = change <= unmoved ? m_start[axis] : rounded(value[axis], visible);
    }
    const std::optional<std::string> text = withNumbers(m_original, {value.data(), 3}, least);
    if (!text) return;
    // Whatever else may have changed the text meanwhile: never write over something else.
    const SourceRange range{m_offset, static_cast<std::uint32_t>(m_written.size())};
    if (m_editor.bytesOf(range) != m_written) {
        m_viewport.letGo();
        return;
    }
    m_written = QByteArray::fromStdString(*text);
    m_editor.replaceRange(range, m_written);
    if (m_handle == BodyHandle::Turn) return;
    DraggedBody written = now;
    const std::vector<double> numbers = numbersOf(*text);
    (m_handle == BodyHandle::Velocity ? written.velocity : written.pose.position) = {numbers[0], numbers[1],
                                                                                     numbers[2]};
    m_viewport.showDragged(written);
}

bool BodyDrag::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && !isModifierKey(static_cast<QKeyEvent&>(*event).key()))
        m_viewport.letGo();
    return QObject::eventFilter(watched, event);
}

void BodyDrag::end() {
    if (!m_dragging) return;
    qApp->removeEventFilter(this);
    m_editor.endUndoAction();
    m_dragging = false;
}

} // namespace carom

#include "moc_body_drag.cpp"
