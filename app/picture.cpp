// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/picture.h"

#include "app/errors.h"
#include "app/files.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "ui/base/file_output.h"
#include "ui/viewport/viewport.h"

#include <QCoreApplication>
#include <QImage>
#include <QTimer>

namespace carom {
namespace {

constexpr int lookInterval = 20; // [ms] between two checks of whether OpenGL is there
constexpr int mostLooks = 3000;  // a minute

} // namespace

int savePicture(const std::string& scene, const PictureRequest& request) {
    const Build built = build(readText(scene));
    World world(built.pipeline);
    for (std::int64_t frame = 0; frame < request.frame; ++frame) world.step();

    Viewport viewport;
    viewport.resize(request.width, request.height);
    viewport.showPipeline(built.pipeline);
    viewport.showSnapshot(std::make_shared<const Snapshot>(world.snapshot()));
    QObject::connect(
        &viewport, &Viewport::failed, &viewport,
        [](const QString& problem) {
            printError("carom: the picture cannot be drawn: " + problem.toStdString() + "\n");
            QCoreApplication::exit(exitcode::fileError);
        },
        Qt::QueuedConnection); // OpenGL may fail before the event loop runs
    QTimer look;
    int looks = 0;
    QObject::connect(&look, &QTimer::timeout, &viewport, [&] {
        const QImage picture = viewport.picture({request.width, request.height});
        if (picture.isNull() && ++looks < mostLooks) return; // a slow machine
        if (picture.isNull()) {
            printError("carom: the picture cannot be drawn: OpenGL has drawn nothing\n");
            QCoreApplication::exit(exitcode::fileError);
            return;
        }
        const QString problem = saveImage(QString::fromStdString(request.file), picture);
        if (!problem.isEmpty()) printError("carom: " + problem.toStdString() + "\n");
        QCoreApplication::exit(problem.isEmpty() ? exitcode::done : exitcode::fileError);
    });
    look.start(lookInterval);
    return QCoreApplication::exec();
}

} // namespace carom
