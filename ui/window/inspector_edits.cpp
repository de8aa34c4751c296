// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/inspector_edits.h"

#include "ui/docks/inspector_dock.h"
#include "ui/editor/scene_editor.h"
#include "ui/window/live_preview.h"

namespace carom {

InspectorEdits::InspectorEdits(InspectorDock& inspector, SceneEditor& editor, const LiveBuild& builds,
                               const LivePreview& preview)
    : QObject(&editor), m_editor(editor), m_builds(builds), m_preview(preview) {
    connect(&inspector, &InspectorDock::valueWanted, this, &InspectorEdits::write);
}

/// The text must be the one that is shown: else the places in it are of another one.
void InspectorEdits::write(BodyIndex body, const QString& parameter, const QString& value) {
    if (body == noBody || !m_builds.isCurrent() || !m_preview.shown()) return;
    const Scene& scene = m_builds.latest()->scene();
    if (scene.bodies.size() != m_preview.shown()->scene().bodies.size()) return;
    if (scene.isGenerated(body)) return; // its figures stand nowhere in the text
    const DeclarationSource& source = scene.bodies[body].source;
    const QByteArray name = parameter.toUtf8(), text = value.toUtf8();
    const std::string_view wanted(name.constData(), static_cast<std::size_t>(name.size()));
    if (const ParameterSource* given = scene.find(source, wanted)) {
        m_editor.replaceRange(given->value, text);
        return;
    }
    const std::uint32_t end = source.declaration.end() - 1; // of what closes it
    const bool spaced = m_editor.bytesOf({end - 1, 1}).trimmed().isEmpty();
    m_editor.replaceRange({end, 0}, (spaced ? QByteArray() : QByteArray(" ")) + name + " " + text + " ");
}

} // namespace carom

#include "moc_inspector_edits.cpp"
