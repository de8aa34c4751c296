// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/failures.h"

#include "ui/base/numbers.h"

#include <QCoreApplication>
#include <QMetaObject>

#include <new>
#include <stdexcept>

namespace carom {
namespace {

struct FailureTexts {
    Q_DECLARE_TR_FUNCTIONS(Failures)
};

} // namespace

QString failureInWords() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        return FailureTexts::tr("there is not enough memory for it");
    } catch (const std::length_error&) { // an array longer than any memory
        return FailureTexts::tr("there is not enough memory for it");
    } catch (const std::exception& error) {
        return FailureTexts::tr("an error inside the program: %1").arg(QString::fromLocal8Bit(error.what()));
    } catch (...) {
        return FailureTexts::tr("an error inside the program");
    }
}

Application::Application(int& argumentCount, char** arguments) : QApplication(argumentCount, arguments) {
    writeNumbersAsScenesDo();
}

bool Application::notify(QObject* receiver, QEvent* event) {
    bool taken = false;
    const QString problem = attempt([&] { taken = QApplication::notify(receiver, event); });
    if (problem.isEmpty()) return taken;
    // Whatever shows it may need what has just run out: later.
    attempt([&] {
        QMetaObject::invokeMethod(
            this, [this, problem] { Q_EMIT failed(problem); }, Qt::QueuedConnection);
    });
    return false;
}

} // namespace carom

#include "moc_failures.cpp"
