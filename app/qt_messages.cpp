// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/qt_messages.h"

#include "app/errors.h"
#include "app/files.h"

#include <QByteArray>
#include <QString>

#include <cstdlib>
#include <string>

namespace carom {
namespace {

void handle(QtMsgType type, const QMessageLogContext&, const QString& message) {
    if (type == QtFatalMsg) {
        const bool ofThePlatform = message.contains(QLatin1StringView("platform plugin"));
        const std::string what =
            ofThePlatform ? "the display cannot be reached; `carom run SCENE` simulates without one"
                          : message.section(QLatin1Char('\n'), 0, 0).toStdString();
        printError("carom: " + what + "\n");
        std::_Exit(exitcode::fileError); // Qt would abort
    }
    static const bool isWanted = qEnvironmentVariableIsSet("QT_LOGGING_RULES");
    if (isWanted || type == QtCriticalMsg) printError(message.toStdString() + "\n");
}

} // namespace

void quietQt() { qInstallMessageHandler(handle); }

} // namespace carom
