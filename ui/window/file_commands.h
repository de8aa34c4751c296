// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/base/document.h"

#include <QObject>

class QDialog;

namespace carom {

class MainWindow;
class Settings;

/// New, open, recent, save, reload: the questions around the document, and what the title says.
class FileCommands : public QObject {
    Q_OBJECT
  public:
    FileCommands(Document& document, MainWindow& window, Settings& settings);

    /// Asks about unsaved changes first; says what went wrong in a box. True if the file is open now.
    bool open(const QString& path);
    /// A text that has no file, made by a part of the program; likewise.
    bool openText(const QString& name, const QByteArray& text);
    /// False: the user wants to stay.
    bool mayDiscard();

  Q_SIGNALS:
    void reported(const QString& sentence);

  private:
    void startNew();
    void startFromGenerator();
    void askAndOpen();
    bool save();
    bool saveAs();
    void reload();
    bool reloadInPlace(const QString& done);
    void reactToOutsideChange();
    void reactToRemoval();
    bool mayOverwrite();
    int askAbout(bool saving);
    int ask(QDialog& dialog);
    void savePicture();
    void updateTitle();
    void fillRecent();
    bool finish(const std::optional<QString>& problem, const QString& done);

    Document& m_document;
    MainWindow& m_window;
    Settings& m_settings;
    bool m_asking = false; ///< one question about the file at a time
    bool m_changedMeanwhile = false;
};

} // namespace carom
