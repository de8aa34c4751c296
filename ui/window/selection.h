// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/window/live_preview.h"

namespace carom {

class SceneEditor;

/// One selected body, seen from both sides: a click on it in the viewport marks and reveals its declaration
/// in the text; the caret in a declaration outlines its body.
class Selection : public QObject {
    Q_OBJECT
  public:
    Selection(SceneEditor& editor, Viewport& viewport, const LiveBuild& builds, const LivePreview& preview);

    /// From the caret's place, again: after another scene has been shown.
    void followCaret();

  Q_SIGNALS:
    void bodySelected(const QString& name);

  private:
    void followClick(BodyIndex body);
    void select(BodyIndex body, SourceRange declaration);
    bool textMatchesPicture() const;

    SceneEditor& m_editor;
    Viewport& m_viewport;
    const LiveBuild& m_builds;
    const LivePreview& m_preview;
    BodyIndex m_body = noBody; ///< told last
};

} // namespace carom
