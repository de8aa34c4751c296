// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/selection.h"

#include "ui/editor/scene_editor.h"
#include "ui/viewport/viewport.h"

#include <algorithm>
#include <utility>

namespace carom {
namespace {

/// The body whose declaration holds the byte at `offset`; bodies stand in the order of the text.
BodyIndex bodyAt(const Scene& scene, std::uint32_t offset) {
    const auto behind = std::upper_bound(
        scene.bodies.begin(), scene.bodies.end(), offset,
        [](std::uint32_t place, const Body& body) { return place < body.source.declaration.offset; });
    if (behind == scene.bodies.begin()) return noBody;
    const SourceRange range = std::prev(behind)->source.declaration;
    return offset <= range.end() ? static_cast<BodyIndex>(behind - scene.bodies.begin() - 1) : noBody;
}

} // namespace

Selection::Selection(SceneEditor& editor, Viewport& viewport, const LiveBuild& builds,
                     const LivePreview& preview)
    : QObject(&editor), m_editor(editor), m_viewport(viewport), m_builds(builds), m_preview(preview) {
    connect(&editor, &SceneEditor::caretMoved, this, &Selection::followCaret);
    connect(&viewport, &Viewport::bodyClicked, this, &Selection::followClick);
}

/// Places in the text are those of the newest build, bodies on screen those of the scene shown. They belong
/// together as long as no edit came between, or none that added or removed a body.
bool Selection::textMatchesPicture() const {
    return m_builds.isCurrent() && m_preview.shown() &&
           m_builds.latest()->scene().bodies.size() == m_preview.shown()->scene().bodies.size();
}

void Selection::followCaret() {
    if (!textMatchesPicture()) return;
    const Scene& scene = m_builds.latest()->scene();
    const BodyIndex body = bodyAt(scene, m_editor.caret());
    select(body, body == noBody ? SourceRange{} : scene.bodies[body].source.declaration);
}

void Selection::followClick(BodyIndex body) {
    if (body == noBody || !textMatchesPicture()) {
        select(body, {});
        return;
    }
    const SourceRange declaration = m_builds.latest()->scene().bodies[body].source.declaration;
    m_editor.reveal({declaration.offset, 0}); // the caret's move selects the body
    select(body, declaration);
}

void Selection::select(BodyIndex body, SourceRange declaration) {
    m_editor.markDeclaration(declaration);
    m_viewport.setSelectedBody(body); // after a click it is so already
    if (std::exchange(m_body, body) == body) return;
    Q_EMIT bodySelected(body == noBody ? QString()
                                       : QString::fromStdString(m_preview.shown()->scene().nameOf(body)));
}

} // namespace carom

#include "moc_selection.cpp"
