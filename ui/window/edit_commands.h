// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace carom {

class DiagnosticMarks;
class Document;
class MainWindow;
class Settings;

/// The Edit menu and what concerns the look of the text.
class EditCommands : public QObject {
    Q_OBJECT
  public:
    EditCommands(MainWindow& window, const Document& document, DiagnosticMarks& marks, Settings& settings);

  private:
    void connectEditing();
    void connectSearch();
    void connectProblems(const Document& document, DiagnosticMarks& marks);
    void connectLook(DiagnosticMarks& marks, Settings& settings);
    void askForLine();

    MainWindow& m_window;
};

} // namespace carom
