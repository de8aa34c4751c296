// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace carom {

class Document;
class FileCommands;
class LiveBuild;
class MainWindow;
class ManualWindow;
class Settings;

/// The Help menu: manual, welcome page, command finder, about.
class HelpCommands : public QObject {
    Q_OBJECT
  public:
    HelpCommands(MainWindow& window, Document& document, FileCommands& files, Settings& settings);

    void showWelcome();
    /// Made when first asked for.
    ManualWindow& manual();

  private:
    void openManualAtCaret();
    void about();

    MainWindow& m_window;
    Document& m_document;
    FileCommands& m_files;
    Settings& m_settings;
    ManualWindow* m_manual = nullptr;
};

} // namespace carom
