// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/settings.h"

#include <QFileInfo>
#include <QSettings>

namespace carom {
namespace {

constexpr qsizetype recentCount = 12;

const QString darkThemeKey = QStringLiteral("look/dark");
const QString inlineMessagesKey = QStringLiteral("editor/inlineMessages");
const QString editorZoomKey = QStringLiteral("editor/zoom");
const QString geometryKey = QStringLiteral("window/geometry");
const QString stateKey = QStringLiteral("window/state");
const QString splitterKey = QStringLiteral("window/splitter");
const QString recentKey = QStringLiteral("files/recent");

} // namespace

bool Settings::darkTheme() const { return QSettings().value(darkThemeKey, true).toBool(); }
void Settings::setDarkTheme(bool dark) { QSettings().setValue(darkThemeKey, dark); }
bool Settings::inlineMessages() const { return QSettings().value(inlineMessagesKey, true).toBool(); }
void Settings::setInlineMessages(bool shown) { QSettings().setValue(inlineMessagesKey, shown); }
int Settings::editorZoom() const { return QSettings().value(editorZoomKey, 0).toInt(); }
void Settings::setEditorZoom(int zoom) { QSettings().setValue(editorZoomKey, zoom); }

QByteArray Settings::windowGeometry() const { return QSettings().value(geometryKey).toByteArray(); }
QByteArray Settings::windowState() const { return QSettings().value(stateKey).toByteArray(); }
QByteArray Settings::splitterState() const { return QSettings().value(splitterKey).toByteArray(); }

void Settings::setWindow(const QByteArray& geometry, const QByteArray& state, const QByteArray& splitter) {
    QSettings settings;
    settings.setValue(geometryKey, geometry);
    settings.setValue(stateKey, state);
    settings.setValue(splitterKey, splitter);
}

QStringList Settings::recentFiles() const {
    QStringList files;
    for (const QString& path : QSettings().value(recentKey).toStringList())
        if (QFileInfo::exists(path)) files.append(path);
    return files;
}

void Settings::addRecentFile(const QString& path) {
    QStringList files = recentFiles();
    files.removeAll(path);
    files.prepend(path);
    QSettings().setValue(recentKey, files.mid(0, recentCount));
}

} // namespace carom
