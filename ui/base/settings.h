// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QString>
#include <QStringList>

#include <optional>

namespace carom {

struct SessionPlace {
    QString path;
    qint64 caret = 0;     ///< [bytes]
    qint64 firstLine = 0; ///< at the top of the editor
};

/// How the window is divided, whatever its size.
struct WindowShares {
    double text = 0;  ///< of the width of text and viewport
    double right = 0; ///< of the window's width
    double below = 0; ///< of its height
};

/// What is remembered between sessions, in the user's configuration directory. Every value has a default that
/// makes a first start look right.
class Settings {
  public:
    bool darkTheme() const;
    void setDarkTheme(bool dark);
    bool wrapsLines() const; ///< of the text, where they do not fit
    void setWrapsLines(bool wraps);
    bool inlineMessages() const;
    void setInlineMessages(bool shown);
    int editorZoom() const; ///< [pt] added to the font's size
    void setEditorZoom(int zoom);

    QByteArray windowGeometry() const;
    void setWindowGeometry(const QByteArray& geometry);
    bool collapsesPanels() const; ///< below the picture, to their tabs
    void setCollapsesPanels(bool collapses);
    /// The workspace used last; the others are kept under their names.
    QString workspace() const;
    QByteArray workspaceState(const QString& name) const;
    std::optional<WindowShares> workspaceShares(const QString& name) const;
    void setWorkspace(const QString& name, const QByteArray& state, const WindowShares& shares);
    void forgetWorkspace(const QString& name);

    /// Newest first; files that are gone are left out.
    QStringList recentFiles() const;
    void addRecentFile(const QString& path);
    /// Where one was in the file edited last.
    SessionPlace lastPlace() const;
    void setLastPlace(const SessionPlace& place);

    /// Family and size [pt] of the editor's font; empty family: the system's fixed one.
    QString fontFamily() const;
    int fontSize() const;
    void setFont(const QString& family, int size);
    /// "en", "de", ...; empty: the system's.
    QString language() const;
    void setLanguage(const QString& code);
    /// Name of the navigation preset of the viewport.
    QString navigation() const;
    void setNavigation(const QString& name);
    /// Name of the place where pictures are drawn.
    QString drawingPlace() const;
    void setDrawingPlace(const QString& name);
    int memoryBudget() const; ///< [MiB] for the checkpoints of a run
    void setMemoryBudget(int mebibytes);
    int threads() const; ///< for simulating; 0: as many as the machine has
    void setThreads(int count);
    /// How far the copy of unsaved text may be behind [ms]; only in the file, no dialog asks for it.
    /// Between two looks at unsaved text [ms].
    static constexpr int defaultRecoveryInterval = 2000;
    int recoveryInterval() const;
    bool welcomeAtStart() const;
    void setWelcomeAtStart(bool shown);
    /// Keys the user gave an action, by the action's name in the table; nothing where it has its own.
    std::optional<QString> keysOf(const QString& action) const;
    void setKeysOf(const QString& action, const std::optional<QString>& keys);
};

} // namespace carom
