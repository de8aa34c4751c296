// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/translation.h"

#include <QCoreApplication>
#include <QLibraryInfo>
#include <QLocale>
#include <QTranslator>

#include <array>

// In the global namespace, as the macro needs it: it makes the linker keep the packed translations.
static void registerTranslations() { Q_INIT_RESOURCE(carom_i18n); }

namespace carom {
namespace {

constexpr std::array rows = {LanguageRow{"en", "English"}, LanguageRow{"de", "Deutsch"}};

const QString translatorName = QStringLiteral("carom-translator");

} // namespace

std::span<const LanguageRow> languages() { return rows; }

void installTranslation(QCoreApplication& application, const QString& code) {
    registerTranslations();
    qDeleteAll(application.findChildren<QTranslator*>(translatorName, Qt::FindDirectChildrenOnly));
    const QLocale locale = code.isEmpty() ? QLocale::system() : QLocale(code);
    const auto load = [&](const QString& name, const QString& folder) {
        QTranslator* translator = new QTranslator(&application);
        translator->setObjectName(translatorName);
        if (translator->load(locale, name, QStringLiteral("_"), folder))
            application.installTranslator(translator);
        else
            delete translator;
    };
    // Qt's own texts (Cancel, Open, ...) first: those of the program are asked before them.
    load(QStringLiteral("qtbase"), QLibraryInfo::path(QLibraryInfo::TranslationsPath));
    load(QStringLiteral("carom"), QStringLiteral(":/i18n"));
}

} // namespace carom
