// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"

#include <QObject>

namespace carom {

class InspectorDock;
class LiveBuild;
class LivePreview;
class SceneEditor;

/// What is written in the inspector goes into the text: over the parameter's value, or, where the declaration
/// does not give it, behind its last one. One undo step each.
class InspectorEdits : public QObject {
    Q_OBJECT
  public:
    InspectorEdits(InspectorDock& inspector, SceneEditor& editor, const LiveBuild& builds,
                   const LivePreview& preview);

  private:
    void write(BodyIndex body, const QString& parameter, const QString& value);

    SceneEditor& m_editor;
    const LiveBuild& m_builds;
    const LivePreview& m_preview;
};

} // namespace carom
