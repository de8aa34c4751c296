// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/body_drag.h"

#include "core/language/number_rewrite.h"
#include "ui/base/keys.h"
#include "ui/editor/scene_editor.h"
#include "ui/simulation/simulation.h"
#include "ui/viewport/viewport.h"
#include "ui/window/live_preview.h"

#include <QApplication>
#include <QKeyEvent>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Decimals that a pixel of the picture can tell apart.
int decimalsOf(double pixel) {
    constexpr int most = 12;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(std::max(pixel, 1e-300)))), 0, most);
}

} // namespace

BodyDrag::BodyDrag(SceneEditor& editor, Viewport& viewport, Simulation& simulation, const LiveBuild& builds,
                   const LivePreview& preview)
    : QObject(&editor), m_editor(editor), m_viewport(viewport), m_simulation(simulation), m_builds(builds),
      m_preview(preview) {
    viewport.setMayDrag([this](BodyIndex body, BodyHandle handle) { return mayDrag(body, nameOf(handle)); });
    connect(&viewport, &Viewport::dragBegan, this,
            [this](BodyIndex body, BodyHandle handle) { begin(body, nameOf(handle)); });
    connect(&viewport, &Viewport::dragged, this, &BodyDrag::moveTo);
    connect(&viewport, &Viewport::dragEnded, this, &BodyDrag::end);
}

/// The text must be the one on screen, and give the value in numbers.
bool BodyDrag::mayDrag(BodyIndex body, std::string_view parameter) const {
    if (m_dragging || !m_simulation.isAtStart() || m_simulation.isRunning() || !m_builds.isCurrent())
        return false;
    if (!m_preview.shown() ||
        m_builds.latest()->scene().bodies.size() != m_preview.shown()->scene().bodies.size())
        return false;
    const Scene& scene = m_builds.latest()->scene();
    const ParameterSource* given = scene.find(scene.bodies[body].source, parameter);
    if (given == nullptr) return false;
    const Vec3& value = parameter == "vel" ? scene.bodies[body].velocity : scene.bodies[body].pose.position;
    const std::string_view text = textOf(m_builds.latest()->build.analysis.text, given->value);
    return withNumbers(text, {value.data(), 3}, 0).has_value();
}

void BodyDrag::begin(BodyIndex body, std::string_view parameter) {
    const Scene& scene = m_builds.latest()->scene();
    const SourceRange value = scene.find(scene.bodies[body].source, parameter)->value;
    m_original = textOf(m_builds.latest()->build.analysis.text, value);
    m_offset = value.offset;
    m_written = QByteArray::fromStdString(m_original);
    m_dragging = true;
    m_editor.beginUndoAction();
    qApp->installEventFilter(this);
}

void BodyDrag::moveTo(const Vec3& value) {
    if (!m_dragging) return;
    const int decimals = decimalsOf(m_viewport.pixelSize());
    const std::optional<std::string> text = withNumbers(m_original, {value.data(), 3}, decimals);
    if (!text) return;
    // Whatever else may have changed the text meanwhile: never write over something else.
    const SourceRange range{m_offset, static_cast<std::uint32_t>(m_written.size())};
    if (m_editor.bytesOf(range) != m_written) {
        m_viewport.letGo();
        return;
    }
    m_written = QByteArray::fromStdString(*text);
    m_editor.replaceRange(range, m_written);
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
