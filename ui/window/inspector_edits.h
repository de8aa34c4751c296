// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/base/source.h"

#include <QByteArray>
#include <QObject>

#include <optional>

namespace carom {

class InspectorDock;
class LiveBuild;
class LivePreview;
class SceneEditor;

/// What is written in the inspector goes into the text: over the parameter's value, or, where the declaration
/// does not give it, behind its last one. One undo step each; so is all that a slider passes until it is let
/// go.
class InspectorEdits : public QObject {
    Q_OBJECT
  public:
    InspectorEdits(InspectorDock& inspector, SceneEditor& editor, LiveBuild& builds,
                   const LivePreview& preview);

  private:
    /// Where a value goes, and what goes around it.
    struct Place {
        SourceRange range;
        QByteArray before, after;
    };
    std::optional<Place> placeOf(BodyIndex body, const QString& parameter) const;
    void write(BodyIndex body, const QString& parameter, const QString& value);
    void begin(BodyIndex body, const QString& parameter);
    void slideTo(const QString& value);
    void end();
    /// While a slider is held: a shortcut ends the undo step first, whatever has the keyboard.
    bool eventFilter(QObject* watched, QEvent* event) override;

    SceneEditor& m_editor;
    LiveBuild& m_builds;
    const LivePreview& m_preview;
    // Of the slider that is held.
    bool m_isHeld = false;
    std::optional<Place> m_slide; ///< its range is kept up to date; while it stands an undo step is open
    QByteArray m_written;         ///< what stands there now
};

} // namespace carom
