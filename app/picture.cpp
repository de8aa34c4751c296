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

constexpr int settleTime = 700; // [ms] until the viewport has drawn the smooth picture of a scene at rest
constexpr int mostLooks = 90;   // at whether it has: a minute

} // namespace

int savePicture(const std::string& scene, const PictureRequest& request) {
    const Build built = build(readText(scene));
    World world(built.pipeline);
    for (std::int64_t frame = 0; frame < request.frame; ++frame) world.step();

    Viewport viewport;
    viewport.setAttribute(Qt::WA_DontShowOnScreen);
    viewport.resize(request.width, request.height);
    viewport.showPipeline(built.pipeline);
    viewport.showSnapshot(std::make_shared<const Snapshot>(world.snapshot()));
    QObject::connect(
        &viewport, &Viewport::failed, &viewport,
        [](const QString& problem) {
            printError("carom: the picture cannot be drawn: " + problem.toStdString() + "\n");
            QCoreApplication::exit(exitcode::fileError);
        },
        Qt::QueuedConnection); // show() may fail before the event loop runs
    viewport.show();
    QTimer look;
    int looks = 0;
    QObject::connect(&look, &QTimer::timeout, &viewport, [&] {
        const QImage picture = viewport.shownPicture();
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
    look.start(settleTime);
    return QCoreApplication::exec();
}

} // namespace carom
