// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/base/theme.h"

#include "core/base/source.h"

#include <QObject>

namespace carom {

class CallTipBox;
class LiveBuild;
class MainWindow;
class SceneEditor;
class SnippetFields;

/// The Text menu: what the language knows about the place one is at. Everything is asked of core, about the
/// text as it is at that moment; nothing waits for the build.
class LanguageCommands : public QObject {
    Q_OBJECT
  public:
    LanguageCommands(MainWindow& window, LiveBuild& builds);

    void setTheme(const Theme& theme);

  private:
    void connectHelp();
    void connectPlaces();
    void connectNumbers(LiveBuild& builds);
    void goToDefinition();
    void format();
    void say(const QString& sentence);

    MainWindow& m_window;
    SceneEditor& m_editor;
    CallTipBox* m_callTip;
    SnippetFields* m_snippets;
};

} // namespace carom
