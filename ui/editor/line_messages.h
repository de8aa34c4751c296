// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "ui/editor/scene_editor.h"

#include <array>
#include <cstdint>
#include <vector>

namespace carom {

/// What is said of a line, under it.
struct LineMessage {
    std::uint32_t offset = 0; ///< of a byte of the line
    Severity severity = Severity::Error;
    QString text;
};

/// The messages in the text: those of a line stand under it, in the colour of the gravest. Several speak
/// here, each of what it knows, because the editor has one place for it.
class LineMessages {
  public:
    enum Speaker : std::uint8_t { Problems, Expectations, SpeakerCount };

    LineMessages(SceneEditor& editor, const Theme& theme);

    /// In place of what this one has said before.
    void say(Speaker speaker, std::vector<LineMessage> messages);
    void setShown(bool shown);
    void setTheme(const Theme& theme);

  private:
    void annotate();

    SceneEditor& m_editor;
    std::array<std::vector<LineMessage>, SpeakerCount> m_messages;
    bool m_shown = true;
    bool m_annotated = false; ///< messages stand in the text
};

} // namespace carom
