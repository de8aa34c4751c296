// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/panel.h"

#include "ui/base/export_menu.h"

namespace carom {

void Panel::setTheme(const Theme&) {}

QString Panel::exportTo(const QString&) const { return tr("there is nothing to export here"); }

ExportMenu* Panel::makeExportMenu(const QString& name) {
    ExportMenu* menu = new ExportMenu(this);
    connect(menu, &ExportMenu::chosen, this,
            [this, name](const QString& ending) { askForExport(name, ending); });
    return menu;
}

QString Panel::askForExport(const QString& name, const QString& ending) {
    const QString path = askForExportPath(this, name, ending);
    if (path.isEmpty()) return {};
    const QString sentence = exportSentence(path, exportTo(path));
    Q_EMIT reported(sentence);
    return sentence;
}

} // namespace carom

#include "moc_panel.cpp"
