// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/export_menu.h"

#include "ui/base/save_dialog.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QMenu>

namespace carom {
namespace {

struct ExportTexts {
    Q_DECLARE_TR_FUNCTIONS(Export)
};

} // namespace

ExportMenu::ExportMenu(QWidget* parent) : QToolButton(parent) {
    setText(tr("Export"));
    setProperty("role", QStringLiteral("words"));
    setPopupMode(QToolButton::InstantPopup);
    setToolTip(tr("Write the chart or its figures to a file"));
    QMenu* menu = new QMenu(this);
    for (const char* ending : {"png", "svg", "pdf", "csv"}) {
        const QString name = QLatin1StringView(ending);
        QAction* action = menu->addAction(tr("%1…").arg(name.toUpper()));
        connect(action, &QAction::triggered, this, [this, name] { Q_EMIT chosen(name); });
    }
    setMenu(menu);
}

QAction& ExportMenu::addEntry(const QString& text) { return *menu()->addAction(text); }

QString askForExportPath(QWidget* parent, const QString& name, const QString& ending) {
    return askWhereToSave(parent, ExportTexts::tr("Export"), name + u'.' + ending,
                          ExportTexts::tr("%1 files (*.%2)").arg(ending.toUpper(), ending));
}

bool isCsv(const QString& path) {
    return QFileInfo(path).suffix().compare(QLatin1StringView("csv"), Qt::CaseInsensitive) == 0;
}

QString exportSentence(const QString& path, const QString& problem) {
    return problem.isEmpty() ? ExportTexts::tr("Written to %1").arg(QDir::toNativeSeparators(path))
                             : ExportTexts::tr("Not exported: %1").arg(problem);
}

} // namespace carom

#include "moc_export_menu.cpp"
