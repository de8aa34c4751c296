// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/base/actions.h"
#include "ui/editor/scene_editor.h"
#include "ui/viewport/viewport.h"
#include "ui/window/main_window.h"
#include "ui/window/workbench.h"

#include <QAbstractItemView>
#include <QAction>
#include <QApplication>
#include <QDebug>
#include <QHash>
#include <QMetaProperty>
#include <QStringList>
#include <QWidget>

#include <algorithm>
#include <iterator>

// What is to be seen of a window, as lines that can be compared: of every widget its place and the properties
// that say what it shows, of tables and lists what is in them, of every action whether it can be chosen and
// how, of the text and the view what one could set there.

namespace carom::test {

using Appearance = QStringList;

/// The properties of a class that say what is to be seen.
inline const QList<QMetaProperty>& shownProperties(const QMetaObject& type) {
    static const QSet<QByteArray> names = {
        "enabled", "toolTip",         "statusTip",     "windowTitle",  "styleSheet", "text",
        "title",   "checked",         "checkable",     "shortcut",     "value",      "minimum",
        "maximum", "currentText",     "count",         "currentIndex", "readOnly",   "plainText",
        "visible", "placeholderText", "windowModified"};
    static QHash<const QMetaObject*, QList<QMetaProperty>> known;
    const auto found = known.constFind(&type);
    if (found != known.constEnd()) return *found;
    QList<QMetaProperty> shown;
    for (int i = 0; i < type.propertyCount(); ++i)
        if (names.contains(type.property(i).name())) shown += type.property(i);
    return *known.insert(&type, shown);
}

inline void describe(const QObject& object, const QString& place, Appearance& lines) {
    for (const QMetaProperty& property : shownProperties(*object.metaObject())) {
        QString value;
        QDebug(&value).nospace() << property.read(&object);
        lines += place + u' ' + QString::fromLatin1(property.name()) + u' ' + value;
    }
}

/// At most so many rows: those of a long table are on screen one page at a time.
inline void describeRows(const QAbstractItemView& view, const QString& place, Appearance& lines) {
    constexpr int most = 100;
    const QAbstractItemModel* model = view.model();
    if (model == nullptr) return;
    lines += place + QStringLiteral(" rows %1").arg(model->rowCount());
    for (int row = 0; row < std::min(most, model->rowCount()); ++row)
        for (int column = 0; column < model->columnCount(); ++column)
            lines += place + u' ' + model->index(row, column).data().toString();
}

/// A window that is not open, such as a menu or a dialog that is made once, comes anew when it is opened, and
/// what is hidden or behind others is laid out when it is shown.
inline void describeWidget(const QWidget& widget, const QString& parent, Appearance& lines) {
    if (widget.isWindow() && !widget.isVisible()) return;
    const bool seen = !widget.visibleRegion().isEmpty();
    const bool anew = widget.inherits("QTabBar") || widget.inherits("QScrollBar") ||
                      widget.inherits("carom::CommandFinder") || widget.inherits("carom::ProgressStrip") ||
                      widget.inherits("carom::OverlayLegend") ||
                      widget.objectName() == QStringLiteral("qt_qmainwindow_extended_splitter");
    const bool spare = !seen && anew;
    if (spare || widget.objectName().startsWith(QStringLiteral("qt_scrollarea"))) return;
    const QString place =
        parent + u'/' + QString::fromLatin1(widget.metaObject()->className()) + widget.objectName();
    if (widget.objectName() == QStringLiteral("memoryInUse")) { // told half a second later
        lines += QStringLiteral("budget") + widget.property("text").toString().section(u' ', 1);
        return;
    }
    if (seen && !(widget.parent() && widget.parent()->inherits("QStatusBar"))) {
        const QRect at = widget.isWindow() ? widget.rect() : widget.geometry();
        QString shown;
        QDebug(&shown) << at << widget.font() << widget.minimumSize() << widget.maximumSize();
        lines += place + shown;
    }
    if (!widget.isHidden() || !widget.inherits("QLabel")) describe(widget, place, lines);
    if (const QAbstractItemView* view = qobject_cast<const QAbstractItemView*>(&widget))
        describeRows(*view, place, lines);
    if (widget.inherits("QTabBar")) return; // its arrows follow its width
    for (const QObject* child : widget.children())
        if (child->isWidgetType()) describeWidget(*static_cast<const QWidget*>(child), place, lines);
}

inline Appearance appearanceOf(const Workbench& bench) {
    const MainWindow& window = bench.window();
    Appearance lines;
    describeWidget(window, {}, lines);
    for (const ActionRow& row : actionRows())
        if (row.text != nullptr)
            describe(window.actions()[row.id], QStringLiteral("action ") + QString::fromLatin1(row.name),
                     lines);
    for (const QWidget* other : QApplication::topLevelWidgets())
        if (other->isVisible() && other != &window)
            lines += QStringLiteral("open: ") + QString::fromLatin1(other->metaObject()->className());
    const SceneEditor& editor = window.editor();
    for (const unsigned int question :
         {QsciScintillaBase::SCI_GETZOOM, QsciScintillaBase::SCI_GETWRAPMODE,
          QsciScintillaBase::SCI_GETSELECTIONS, QsciScintillaBase::SCI_TEXTHEIGHT,
          QsciScintillaBase::SCI_CANUNDO, QsciScintillaBase::SCI_CANREDO, QsciScintillaBase::SCI_GETXOFFSET,
          QsciScintillaBase::SCI_GETOVERTYPE, QsciScintillaBase::SCI_GETLENGTH})
        lines += QStringLiteral("text %1: %2").arg(question).arg(editor.send(question));
    const Viewport& viewport = window.viewport();
    lines += QStringLiteral("overlays %1, selected %2, told %3, %4 %5")
                 .arg(QString::number(viewport.overlays()), QString::number(viewport.selectedBody()),
                      viewport.told(), viewport.camera().orthographic ? u"orthographic" : u"perspective",
                      viewport.drawsInWindow() ? u"window" : u"thread");
    QString style;
    QDebug(&style).nospace() << QApplication::palette() << QApplication::font();
    lines += style + qApp->styleSheet();
    lines.sort(); // a panel that was in front once stands behind others in the list
    return lines;
}

inline void tellDifference(const Appearance& before, const Appearance& now) {
    QStringList gone, came;
    std::set_difference(before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(gone));
    std::set_difference(now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(came));
    for (const QString& line : gone.mid(0, 6)) qInfo("before: %s", qPrintable(line));
    for (const QString& line : came.mid(0, 6)) qInfo("now:    %s", qPrintable(line));
}

} // namespace carom::test
