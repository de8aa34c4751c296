// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/ide.h"

#include "app/errors.h"
#include "app/files.h"
#include "app/picture.h"
#include "app/qt_messages.h"
#include "app/timed_session.h"
#include "app/version.h"
#include "ui/base/failures.h"
#include "ui/player/simulation.h"
#include "ui/window/help_commands.h"
#include "ui/window/main_window.h"
#include "ui/base/settings.h"
#include "ui/window/translation.h"
#include "ui/window/workbench.h"

#include <QApplication>
#include <QIcon>
#include <QTimer>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace carom {
namespace {

constexpr std::chrono::seconds longestEnd{2}; // that threads are given when the window is closed
constexpr int settleTime = 500;               // [ms] until a window that only has its picture taken is drawn

void describeApplication() {
    QApplication::setOrganizationName(QStringLiteral("carom"));
    QApplication::setApplicationName(QStringLiteral("carom"));
    QApplication::setApplicationDisplayName(QString());
    QApplication::setApplicationVersion(QString::fromUtf8(version().data()));
    QApplication::setWindowIcon(QIcon(QStringLiteral(":/icons/carom.svg")));
    QApplication::setDesktopFileName(QStringLiteral("org.carom.carom"));
}

/// After the window is closed the program does not wait for the frame that is being simulated, which can take
/// minutes: after a while it ends with its threads. Everything is saved before that.
std::jthread limitOfTheEnd(int exitCode) {
    return std::jthread([exitCode](const std::stop_token& stop) {
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any never;
        never.wait_for(lock, stop, longestEnd, [] { return false; });
        if (stop.stop_requested()) return;
        std::fflush(nullptr);
        std::_Exit(exitCode);
    });
}

/// Throws FileError for standard input; an error with a file is returned.
std::optional<QString> openScene(const Workbench& workbench, const std::string& scene) {
    if (scene != "-") {
        const std::optional<QString> problem = workbench.document().open(QString::fromStdString(scene));
        if (!problem) Settings().addRecentFile(workbench.document().path());
        return problem;
    }
    workbench.document().startNew(QByteArray::fromStdString(readText(scene)));
    return std::nullopt;
}

} // namespace

int runIde(const IdeRequest& request) {
    quietQt();
    std::string program = request.program;
    char* arguments[] = {program.data(), nullptr};
    int argumentCount = 1;
    Application application(argumentCount, arguments);
    describeApplication();
    installTranslation(application, Settings().language());
    if (request.picture) return savePicture(*request.scene, *request.picture);

    std::jthread limit; // before the workbench: it outlives it
    Workbench workbench;
    if (request.scene) {
        if (const std::optional<QString> problem = openScene(workbench, *request.scene)) {
            printError("carom: " + problem->toStdString() + "\n");
            return exitcode::fileError;
        }
    }
    const bool goesOn = request.scene || workbench.openLastOrFirst();
    std::optional<TimedSession> session;
    if (request.frames) session.emplace(workbench, *request.frames, request.screenshot);
    workbench.window().show();
    const bool somebodyIsThere = !request.frames && !request.screenshot;
    if (somebodyIsThere) {
        workbench.keepUnsavedText();
        if (!workbench.offerRecovery() && !goesOn && Settings().welcomeAtStart())
            workbench.help().showWelcome();
    }
    if (request.play || request.frames) workbench.playWhenBuilt();
    if (request.screenshot && !request.frames)
        QTimer::singleShot(settleTime, &workbench, [&] {
            QApplication::exit(saveWindow(workbench, *request.screenshot) ? 0 : exitcode::fileError);
        });
    const int exitCode = QApplication::exec();
    limit = limitOfTheEnd(exitCode);
    return exitCode;
}

} // namespace carom
