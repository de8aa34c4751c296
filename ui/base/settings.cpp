// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/settings.h"

#include <QFileInfo>
#include <QSettings>
#include <QVariantList>

#include <algorithm>

namespace carom {
namespace {

constexpr qsizetype recentCount = 12;

const QString darkThemeKey = QStringLiteral("look/dark");
const QString inlineMessagesKey = QStringLiteral("editor/inlineMessages");
const QString wrapKey = QStringLiteral("editor/wrap");
const QString editorZoomKey = QStringLiteral("editor/zoom");
const QString geometryKey = QStringLiteral("window/geometry");
const QString workspaceKey = QStringLiteral("workspace/current");
const QString stateKey = QStringLiteral("workspace/%1/state");
const QString sharesKey = QStringLiteral("workspace/%1/shares");
const QString collapseKey = QStringLiteral("workspace/collapsed");
const QString placeKey = QStringLiteral("files/place");
const QString fontFamilyKey = QStringLiteral("editor/font");
const QString fontSizeKey = QStringLiteral("editor/fontSize");
const QString languageKey = QStringLiteral("look/language");
const QString navigationKey = QStringLiteral("viewport/navigation");
const QString drawingPlaceKey = QStringLiteral("viewport/drawing");
const QString memoryKey = QStringLiteral("simulation/memory");
const QString threadsKey = QStringLiteral("simulation/threads");
const QString recoveryKey = QStringLiteral("recovery/interval");
const QString welcomeKey = QStringLiteral("window/welcome");
const QString keysKey = QStringLiteral("keys/%1");

constexpr int defaultFontSize = 10; // [pt]
constexpr int defaultMemory = 512;  // [MiB]
const QString recentKey = QStringLiteral("files/recent");

} // namespace

bool Settings::darkTheme() const { return QSettings().value(darkThemeKey, true).toBool(); }
void Settings::setDarkTheme(bool dark) { QSettings().setValue(darkThemeKey, dark); }
bool Settings::collapsesPanels() const { return QSettings().value(collapseKey, false).toBool(); }
void Settings::setCollapsesPanels(bool collapses) { QSettings().setValue(collapseKey, collapses); }
bool Settings::wrapsLines() const { return QSettings().value(wrapKey, true).toBool(); }
void Settings::setWrapsLines(bool wraps) { QSettings().setValue(wrapKey, wraps); }
bool Settings::inlineMessages() const { return QSettings().value(inlineMessagesKey, true).toBool(); }
void Settings::setInlineMessages(bool shown) { QSettings().setValue(inlineMessagesKey, shown); }
int Settings::editorZoom() const { return QSettings().value(editorZoomKey, 0).toInt(); }
void Settings::setEditorZoom(int zoom) { QSettings().setValue(editorZoomKey, zoom); }

QByteArray Settings::windowGeometry() const { return QSettings().value(geometryKey).toByteArray(); }
void Settings::setWindowGeometry(const QByteArray& geometry) { QSettings().setValue(geometryKey, geometry); }

QString Settings::workspace() const { return QSettings().value(workspaceKey).toString(); }
QByteArray Settings::workspaceState(const QString& name) const {
    return QSettings().value(stateKey.arg(name)).toByteArray();
}
std::optional<WindowShares> Settings::workspaceShares(const QString& name) const {
    const QVariantList shares = QSettings().value(sharesKey.arg(name)).toList();
    if (shares.size() != 3) return std::nullopt;
    return WindowShares{shares[0].toDouble(), shares[1].toDouble(), shares[2].toDouble()};
}
void Settings::setWorkspace(const QString& name, const QByteArray& state, const WindowShares& shares) {
    QSettings settings;
    settings.setValue(workspaceKey, name);
    settings.setValue(stateKey.arg(name), state);
    settings.setValue(sharesKey.arg(name), QVariantList{shares.text, shares.right, shares.below});
}
void Settings::forgetWorkspace(const QString& name) {
    QSettings settings;
    settings.remove(stateKey.arg(name));
    settings.remove(sharesKey.arg(name));
}

SessionPlace Settings::lastPlace() const {
    const QVariantList place = QSettings().value(placeKey).toList();
    if (place.size() != 3) return {};
    return {place[0].toString(), place[1].toLongLong(), place[2].toLongLong()};
}
void Settings::setLastPlace(const SessionPlace& place) {
    QSettings().setValue(placeKey, QVariantList{place.path, place.caret, place.firstLine});
}

QString Settings::fontFamily() const { return QSettings().value(fontFamilyKey).toString(); }
int Settings::fontSize() const { return QSettings().value(fontSizeKey, defaultFontSize).toInt(); }
void Settings::setFont(const QString& family, int size) {
    QSettings settings;
    settings.setValue(fontFamilyKey, family);
    settings.setValue(fontSizeKey, size);
}
QString Settings::language() const { return QSettings().value(languageKey).toString(); }
void Settings::setLanguage(const QString& code) { QSettings().setValue(languageKey, code); }
QString Settings::navigation() const { return QSettings().value(navigationKey).toString(); }
void Settings::setNavigation(const QString& name) { QSettings().setValue(navigationKey, name); }
QString Settings::drawingPlace() const { return QSettings().value(drawingPlaceKey).toString(); }
void Settings::setDrawingPlace(const QString& name) { QSettings().setValue(drawingPlaceKey, name); }
int Settings::memoryBudget() const { return QSettings().value(memoryKey, defaultMemory).toInt(); }
void Settings::setMemoryBudget(int mebibytes) { QSettings().setValue(memoryKey, mebibytes); }
int Settings::threads() const { return QSettings().value(threadsKey, 0).toInt(); }
void Settings::setThreads(int count) { QSettings().setValue(threadsKey, count); }
int Settings::recoveryInterval() const {
    /// [ms]; the disk is written that often during typing, at a tenth without a pause.
    constexpr int shortest = 100;
    return std::max(shortest, QSettings().value(recoveryKey, defaultRecoveryInterval).toInt());
}
bool Settings::welcomeAtStart() const { return QSettings().value(welcomeKey, true).toBool(); }
void Settings::setWelcomeAtStart(bool shown) { QSettings().setValue(welcomeKey, shown); }

std::optional<QString> Settings::keysOf(const QString& action) const {
    const QVariant keys = QSettings().value(keysKey.arg(action));
    return keys.isValid() ? std::optional(keys.toString()) : std::nullopt;
}
void Settings::setKeysOf(const QString& action, const std::optional<QString>& keys) {
    QSettings settings;
    if (keys)
        settings.setValue(keysKey.arg(action), *keys);
    else
        settings.remove(keysKey.arg(action));
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
