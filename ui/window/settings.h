// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QString>
#include <QStringList>

namespace carom {

/// What is remembered between sessions, in the user's configuration directory. Every value has a default that
/// makes a first start look right.
class Settings {
  public:
    bool darkTheme() const;
    void setDarkTheme(bool dark);
    bool inlineMessages() const;
    void setInlineMessages(bool shown);
    int editorZoom() const; ///< [pt] added to the font's size
    void setEditorZoom(int zoom);

    QByteArray windowGeometry() const;
    QByteArray windowState() const;
    QByteArray splitterState() const;
    void setWindow(const QByteArray& geometry, const QByteArray& state, const QByteArray& splitter);

    /// Newest first; files that are gone are left out.
    QStringList recentFiles() const;
    void addRecentFile(const QString& path);
};

} // namespace carom
