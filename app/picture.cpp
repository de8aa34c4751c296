// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/picture.h"

#include "app/errors.h"
#include "app/files.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "ui/viewport/viewport.h"

#include <QCoreApplication>
#include <QImage>
#include <QTimer>

namespace carom {
namespace {

constexpr int settleTime = 700; // [ms] until the viewport has drawn the smooth picture of a scene at rest

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
    viewport.show();
    QTimer::singleShot(settleTime, &viewport, [&viewport, &request] {
        const bool saved = viewport.shownPicture().save(QString::fromStdString(request.file), "PNG");
        if (!saved)
            printError("carom: cannot write `" + request.file +
                       "`; a PNG file in a folder that exists would be right\n");
        QCoreApplication::exit(saved ? exitcode::done : exitcode::fileError);
    });
    return QCoreApplication::exec();
}

} // namespace carom
